#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seine::io {

/// ": did you mean 'x'?" for the word nearest to `word`, or nothing when none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& known);

/// "a, b or c".
std::string one_of(const std::vector<std::string_view>& known);

}  // namespace seine::io
