#pragma once

#include <cstdint>
#include <filesystem>

namespace seine::deceive {

/// Plans `count` random tasks of all families, writes and reads each plan, and certifies what was read.
/// Prints those that are refused, saves them in `folder`, and returns how many of them are clean by the
/// look, together with how many are certified and wrong by it.
long refused_though_clean(std::uint64_t first_seed, long count, unsigned threads,
                          const std::filesystem::path& folder);

}  // namespace seine::deceive
