#pragma once

#include <string>
#include <string_view>

namespace seine::io {

/// Walks over a YAML text without building anything. Throws InputError when it is not valid, nested deeper
/// than any of our formats, or goes on after its first document.
void expect_one_shallow_document(std::string_view text, const std::string& file);

/// What yaml-cpp says of a text that it cannot read, on one line.
std::string yaml_complaint(const std::string& said);

}  // namespace seine::io
