#include "seine/io/message.hpp"

namespace seine::io {

InputError complaint(const std::string& file, int line, const std::string& message) {
  std::string text = file;
  if (line > 0) text += joined(':', line);
  return InputError(joined(text, ": ", message));
}

}  // namespace seine::io
