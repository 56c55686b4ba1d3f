#include "seine/io/message.hpp"

namespace seine::io {
namespace {

// How many bytes the UTF-8 character at the front of `text` has; 0 where there is none that can be printed.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first < 0x20 || first == 0x7f ? 0 : 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const unsigned second = byte(1);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool beyond = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  const bool control = first == 0xc2 && second < 0xa0;
  return overlong || beyond || control ? 0 : length;
}

std::string cleaned(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character(text);
    if (length == 0)
      out += '?';
    else
      out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  if (text.size() <= most) return cleaned(text);
  const std::string_view whole = text;
  std::size_t head = most - most / 3, tail = text.size() - most / 3;
  // Not through the middle of a character.
  const auto inside = [&](std::size_t i) {
    return i > 0 && i < whole.size() && (static_cast<unsigned char>(whole[i]) & 0xc0) == 0x80;
  };
  for (int k = 0; k < 3 && inside(head); ++k) --head;
  for (int k = 0; k < 3 && inside(tail); ++k) ++tail;
  return cleaned(text.substr(0, head)) + "..." + cleaned(text.substr(tail));
}

InputError complaint(const std::string& file, int line, const std::string& message) {
  std::string text = file;
  if (line > 0) text += joined(':', line);
  return InputError(joined(text, ": ", message));
}

}  // namespace seine::io
