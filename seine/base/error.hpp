#pragma once

#include <stdexcept>
#include <string>

namespace seine {

/// The root of every exception Seine throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Something the user gave is wrong: a file, a value, an option. `what()` is one line that names the place
/// and what was expected.
class InputError : public Error {
 public:
  using Error::Error;
  /// @param line 1-based; 0 when the place has no line.
  InputError(const std::string& file, int line, const std::string& message)
      : Error(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + message) {}
};

}  // namespace seine
