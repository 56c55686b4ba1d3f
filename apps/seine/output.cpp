#include "apps/seine/output.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "seine/base/error.hpp"
#include "seine/io/file_bytes.hpp"

namespace seine::app {
namespace {

namespace fs = std::filesystem;

bool is_where_stdout_goes(const std::string& path) {
  struct stat file {
  }, out{};
  return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &out) == 0 && S_ISREG(file.st_mode) &&
         file.st_dev == out.st_dev && file.st_ino == out.st_ino;
}

/// The folder in which the file will lie, once its links are followed.
fs::path folder_of(const fs::path& path) {
  std::error_code error;
  const fs::path end = fs::weakly_canonical(path, error);
  return error || end.parent_path().empty() ? fs::path(".") : end.parent_path();
}

}  // namespace

bool is_stdout(const std::string& path) {
  return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

void print(std::string_view text) {
  if (!io::write_all(STDOUT_FILENO, text))
    throw InputError(std::string("stdout: cannot be written: ") + std::strerror(errno));
}

void tell(std::string_view text, const std::string& output) {
  if (!is_stdout(output)) return print(text);
  static_cast<void>(io::write_all(STDERR_FILENO, text));
}

void expect_writable(const std::string& path, const io::Reading& reading) {
  for (const io::Reading::File& file : reading.files)
    if (is_where_stdout_goes(file.path))
      throw StdoutIsRead(file.path.string() + ": is read and is where stdout goes");
  if (path.empty() || is_stdout(path)) return;
  std::error_code error;
  const fs::path folder = folder_of(path);
  if (fs::is_directory(path, error))
    throw InputError(path + ": is a folder, expected the name of a file to write");
  if (!fs::is_directory(folder, error)) throw InputError(path + ": there is no folder " + folder.string());
  const fs::path target = fs::exists(path, error) ? fs::path(path) : folder;
  if (::access(target.c_str(), W_OK) != 0) throw InputError(path + ": no permission to write there");
  if (is_where_stdout_goes(path))
    throw InputError(path + ": is where stdout goes, expected another file, or - for stdout alone");
  io::expect_not_read(path, reading);
}

void write_output(const std::string& path, std::string_view content) {
  if (is_stdout(path)) return print(content);
  io::write_file(path, content);
}

}  // namespace seine::app
