#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace seine::io {

/// The whole file. Throws InputError when it is missing, a directory, unreadable or larger than `limit`
/// bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit);

/// A text whose lines end with '\n': old programs end them with '\r' alone.
std::string with_line_ends(std::string_view text);

/// Why that file cannot be read ("No such file or directory"); empty when it can.
std::string why_unreadable(const std::filesystem::path& path);

/// A text without the byte order mark (UTF-8) that some programs write at its beginning.
std::string_view without_mark(std::string_view text);

/// Writes all of `content` or nothing, where the file system can. A file that is replaced keeps its mode, its
/// owner and all its names (symbolic and hard links); one with several hard links or another owner is
/// overwritten in place, once there is room for all of it. An interrupted write leaves nothing behind. Where
/// `path` is no regular file (a pipe, a terminal) it is written directly. Throws InputError when that fails.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Writes to an open file, all of it. False, with errno, when that fails.
bool write_all(int file, std::string_view content);

}  // namespace seine::io
