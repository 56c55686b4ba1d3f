#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace seine::sim {

/// Appends the shortest text that reads back as the same number; "nan" and the like for what is none.
inline void append_number(std::string& out, double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value).ptr;
  out.append(text, end);
}

/// For logs: rounded to `digits` after the point first, so that files stay small.
inline void append_rounded(std::string& out, double value, int digits) {
  const double scale = std::pow(10.0, digits);
  append_number(out, std::round(value * scale) / scale);
}

}  // namespace seine::sim
