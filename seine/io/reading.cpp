#include "seine/io/reading.hpp"

#include <sys/stat.h>

#include <algorithm>

#include "seine/io/message.hpp"

namespace seine::io {

std::optional<FileId> file_id(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return FileId{static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino)};
}

void Reading::add_file(const std::filesystem::path& path) {
  if (const std::optional<FileId> id = file_id(path)) files.push_back({path, *id});
}

void expect_not_read(const std::filesystem::path& output, const Reading& reading) {
  const std::optional<FileId> id = file_id(output);
  if (!id) return;
  const auto same = std::ranges::find(reading.files, *id, &Reading::File::id);
  if (same == reading.files.end()) return;
  const std::string also = same->path == output ? "" : joined(", as ", same->path.string());
  throw complaint(output.string(), 0,
                  joined("is read by this command", also, ", expected another file to write"));
}

}  // namespace seine::io
