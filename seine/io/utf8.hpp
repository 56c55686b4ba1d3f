#pragma once

#include <string>
#include <string_view>

namespace seine::io {

/// Whether all of `text` is UTF-8: no stray bytes, overlong forms, surrogates or values above U+10FFFF.
bool is_utf8(std::string_view text);

/// `text` with '?' for every byte that is none: for names made of what a user's disk says.
std::string as_utf8(std::string_view text);

}  // namespace seine::io
