#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seine::io {

/// Which file a name stands for: two names of one file (links, "./") have the same.
struct FileId {
  std::uint64_t device = 0, inode = 0;
  bool operator==(const FileId&) const = default;
};

/// Of the regular file that `path` leads to; nothing where there is none (a folder, a pipe, no file).
std::optional<FileId> file_id(const std::filesystem::path& path);

/// What reading a task met on the way.
struct Reading {
  struct File {
    std::filesystem::path path;  ///< as it was named
    FileId id;
  };
  /// Places in the file, "file:line"; empty where the format has no lines.
  struct Ends {
    std::string start, goal;
  };
  std::vector<File> files;  ///< all that were read: the task, what it imports, its map and picture
  std::vector<std::string>
      notes;                 ///< what looks like a slip and was read all the same, "file:line: sentence"
  std::vector<Ends> robots;  ///< in the order of the scenario's; may be shorter

  /// Notes that `path` is read. Nothing for what is no regular file: it cannot be replaced.
  void add_file(const std::filesystem::path& path);
};

/// Throws InputError where writing `output` would replace a file that was read.
void expect_not_read(const std::filesystem::path& output, const Reading& reading);

}  // namespace seine::io
