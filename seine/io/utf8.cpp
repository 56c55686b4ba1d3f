#include "seine/io/utf8.hpp"

#include <cstddef>

namespace seine::io {
namespace {

/// Bytes of the character that `text` begins with; 0 where that is none.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto within = [&](std::size_t i, unsigned low, unsigned high) {
    return low <= byte(i) && byte(i) <= high;
  };
  const auto more = [&](std::size_t i) { return within(i, 0x80, 0xbf); };
  if (within(0, 0x00, 0x7f)) return 1;
  if (within(0, 0xc2, 0xdf)) return more(1) ? 2 : 0;
  const bool three = (byte(0) == 0xe0 && within(1, 0xa0, 0xbf)) || (within(0, 0xe1, 0xec) && more(1)) ||
                     (byte(0) == 0xed && within(1, 0x80, 0x9f)) || (within(0, 0xee, 0xef) && more(1));
  if (three) return more(2) ? 3 : 0;
  const bool four = (byte(0) == 0xf0 && within(1, 0x90, 0xbf)) || (within(0, 0xf1, 0xf3) && more(1)) ||
                    (byte(0) == 0xf4 && within(1, 0x80, 0x8f));
  return four && more(2) && more(3) ? 4 : 0;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string as_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character(text);
    out += length > 0 ? text.substr(0, length) : std::string_view("?");
    text.remove_prefix(length > 0 ? length : 1);
  }
  return out;
}

}  // namespace seine::io
