#pragma once

#include <string>
#include <string_view>

#include "seine/base/error.hpp"
#include "seine/io/reading.hpp"

namespace seine::app {

/// What goes to stdout would overwrite a file that was read: not even the error may be printed there.
class StdoutIsRead : public InputError {
 public:
  using InputError::InputError;
};

/// Whether the name stands for the standard output: "-", or what the system calls it.
bool is_stdout(const std::string& path);

/// Writes to stdout, all of it and now. Throws InputError when that fails: a full disk, a closed descriptor.
void print(std::string_view text);

/// What people read: to stdout, or to stderr where stdout carries the output itself.
void tell(std::string_view text, const std::string& output);

/// Throws InputError now when `path` could not be written later, or is a file that has been read: a long
/// computation must not end in that message. An empty path is no file.
void expect_writable(const std::string& path, const io::Reading& reading);

/// Writes the file whole or not at all, or to stdout.
void write_output(const std::string& path, std::string_view content);

}  // namespace seine::app
