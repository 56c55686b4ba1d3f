#include "seine/io/json_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"

namespace seine::io {

std::string json_number(double value) {
  return std::isfinite(value) ? number_text(value) : "null";
}

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void JsonObject::add(std::string_view key, double value) {
  add_raw(key, json_number(value));
}
void JsonObject::add(std::string_view key, int value) {
  add_raw(key, std::to_string(value));
}
void JsonObject::add(std::string_view key, bool value) {
  add_raw(key, value ? "true" : "false");
}
void JsonObject::add(std::string_view key, std::string_view text) {
  add_raw(key, json_string(text));
}

void JsonObject::add_raw(std::string_view key, std::string_view json) {
  entries_.push_back(joined(json_string(key), ": ", json));
}

std::string JsonObject::text(const char* between, const char* open, const char* close) const {
  std::string out = open;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (i > 0) out += between;
    out += entries_[i];
  }
  out += close;
  return out;
}

}  // namespace seine::io
