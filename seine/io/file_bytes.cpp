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

void write_directly(const fs::path& path, std::string_view content, const fs::path& shown) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (out) return;
  const std::string why = errno != 0 ? std::strerror(errno) : "write failed";
  throw complaint(shown.string(), 0, "cannot be written: " + why);
}

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

std::string_view without_mark(std::string_view text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

void write_file(const fs::path& path, std::string_view content) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw complaint(path.string(), 0, "is a directory, expected a file name");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_directly(path, content, path);
  // A symbolic link keeps pointing where it does: its target is what is replaced.
  fs::path target = fs::is_regular_file(status) ? fs::canonical(path, error) : path;
  if (error) target = path;
  fs::path draft = target;
  draft += ".part" + std::to_string(::getpid());
  try {
    write_directly(draft, content, path);
    fs::rename(draft, target);
  } catch (const fs::filesystem_error& failure) {
    fs::remove(draft, error);
    throw complaint(path.string(), 0, "cannot be written: " + failure.code().message());
  } catch (...) {
    fs::remove(draft, error);
    throw;
  }
}

}  // namespace seine::io
