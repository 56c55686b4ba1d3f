#include "seine/io/file_bytes.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>

#include "seine/io/message.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string read_file(const fs::path& path, std::size_t limit) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw complaint(path.string(), 0, "is a directory, expected a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw complaint(path.string(), 0,
                    std::string("cannot be read: ") + (errno != 0 ? std::strerror(errno) : "?"));
  }
  const auto too_large = [&] {
    return complaint(path.string(), 0,
                     "is too large, expected at most " + std::to_string(limit >> 20) + " MiB");
  };
  if (fs::is_regular_file(path, error)) {
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error && size > limit) throw too_large();
  }
  // Read in chunks: pipes have no size, and a size reported by the file system may lie.
  std::string content;
  char chunk[1 << 16];
  while (in.read(chunk, sizeof chunk), in.gcount() > 0) {
    content.append(chunk, static_cast<std::size_t>(in.gcount()));
    if (content.size() > limit) throw too_large();
  }
  if (in.bad()) throw complaint(path.string(), 0, "cannot be read to its end");
  return content;
}

std::string with_line_ends(std::string_view text) {
  std::string out(text);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (out[i] == '\r' && (i + 1 == out.size() || out[i + 1] != '\n')) out[i] = '\n';
  return out;
}

std::string why_unreadable(const fs::path& path) {
  return ::access(path.c_str(), R_OK) == 0 ? "" : std::strerror(errno);
}

std::string_view without_mark(std::string_view text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

}  // namespace seine::io
