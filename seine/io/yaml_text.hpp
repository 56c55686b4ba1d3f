#pragma once

#include <string>

namespace seine::io {

/// A YAML scalar that reads back as exactly this text: plain where no reader can take it for anything else,
/// else in quotes.
std::string yaml_scalar(const std::string& text);

}  // namespace seine::io
