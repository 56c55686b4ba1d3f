#pragma once

#include <string>
#include <string_view>

#include "seine/sim/number_format.hpp"

namespace seine::sim {

/// Writes JSON from left to right, commas included.
class JsonText {
 public:
  JsonText& open(char bracket) {
    comma();
    text_ += bracket;
    first_ = true;
    return *this;
  }
  JsonText& close(char bracket) {
    text_ += bracket;
    first_ = false;
    return *this;
  }
  JsonText& key(std::string_view name) {
    comma();
    quote(name);
    text_ += ':';
    first_ = true;  // its value follows without a comma
    return *this;
  }
  JsonText& text(std::string_view value) {
    comma();
    quote(value);
    return *this;
  }
  /// Rounded to micrometres and the like; null for what is no number.
  JsonText& number(double value) {
    comma();
    if (std::isfinite(value)) {
      append_rounded(text_, value, 6);
    } else {
      text_ += "null";
    }
    return *this;
  }
  JsonText& boolean(bool value) { return raw(value ? "true" : "false"); }
  /// JSON as it is.
  JsonText& raw(std::string_view json) {
    comma();
    text_ += json;
    return *this;
  }

  JsonText& field(std::string_view name, double value) { return key(name).number(value); }
  JsonText& field(std::string_view name, std::string_view value) { return key(name).text(value); }
  const std::string& str() const { return text_; }

 private:
  void comma() {
    if (!first_) text_ += ',';
    first_ = false;
  }
  void quote(std::string_view value) {
    text_ += '"';
    for (const char c : value) {
      if (c == '"' || c == '\\') text_ += '\\';
      if (static_cast<unsigned char>(c) < 0x20) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        text_ += "\\u00";
        text_ += kDigits[static_cast<std::size_t>(c) / 16];
        text_ += kDigits[static_cast<std::size_t>(c) % 16];
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }

  std::string text_;
  bool first_ = true;
};

}  // namespace seine::sim
