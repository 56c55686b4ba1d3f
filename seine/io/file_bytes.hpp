#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace seine::io {

/// The whole file. Throws InputError when it is missing, a directory, unreadable or larger than `limit`
/// bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit);

/// A text without the byte order mark (UTF-8) that some programs write at its beginning.
std::string_view without_mark(std::string_view text);

/// Writes all of `content` or nothing: into a neighbour file first, then renamed over `path`. Where `path` is
/// no regular file (a pipe, a terminal) it is written directly. Throws InputError when that fails.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace seine::io
