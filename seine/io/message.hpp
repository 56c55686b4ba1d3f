#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "seine/base/error.hpp"

namespace seine::io {

namespace detail {
inline void append(std::string& out, std::string_view part) {
  out += part;
}
inline void append(std::string& out, char part) {
  out += part;
}
template <std::integral Integer>
void append(std::string& out, Integer part) {
  out += std::to_string(part);
}
}  // namespace detail

/// Texts and whole numbers one after the other.
template <class... Parts>
std::string joined(const Parts&... parts) {
  std::string out;
  (detail::append(out, parts), ...);
  return out;
}

/// Text of a user's, fit for a message: control characters and what is no UTF-8 as '?', and at most so many
/// bytes, what is left out in the middle as "...".
std::string printable(std::string_view text, std::size_t most);

/// The exception "file:line: message"; no line when it is 0.
InputError complaint(const std::string& file, int line, const std::string& message);

}  // namespace seine::io
