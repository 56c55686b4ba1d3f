#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seine::io {

/// Builds one JSON object line by line; values keep every bit of a double.
class JsonObject {
 public:
  void add(std::string_view key, double value);  ///< null where it is not finite
  void add(std::string_view key, int value);
  void add(std::string_view key, bool value);
  void add(std::string_view key, std::string_view text);
  void add(std::string_view key, const char* text) { add(key, std::string_view(text)); }
  void add(std::string_view key, const std::string& text) { add(key, std::string_view(text)); }
  /// `json` as it stands.
  void add_raw(std::string_view key, std::string_view json);

  /// { "key": value, … } with an entry a line.
  std::string lines() const { return text(",\n ", "{\n ", "\n}"); }
  /// The same on one line.
  std::string line() const { return text(", ", "{", "}"); }

 private:
  std::string text(const char* between, const char* open, const char* close) const;
  std::vector<std::string> entries_;
};

std::string json_number(double value);
/// In quotes, escaped; bytes that are no UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

}  // namespace seine::io
