#pragma once

#include <cstring>

namespace seine::math {

/// Four doubles that the compiler keeps in one vector register where the machine has one. For the few places
/// where a plain loop does not become vector code: sums across lanes.
using Quad [[gnu::vector_size(32)]] = double;

/// The sums of the four entries of each of a, b, c, d, as one quad. (By reference: quads in and out of
/// functions by value have no common calling convention.)
[[gnu::always_inline]] inline void sums(const Quad& a, const Quad& b, const Quad& c, const Quad& d,
                                        Quad& result) {
  const Quad ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  result = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

/// The sums of all entries of four rows of eight, as one quad.
using Row = double[8];
[[gnu::always_inline]] inline void sums(const Row& a, const Row& b, const Row& c, const Row& d,
                                        Quad& result) {
  const Row* const rows[4] = {&a, &b, &c, &d};
  Quad half[4];
  for (int i = 0; i < 4; ++i) {
    Quad high;
    std::memcpy(&half[i], *rows[i], sizeof high);
    std::memcpy(&high, *rows[i] + 4, sizeof high);
    half[i] += high;
  }
  sums(half[0], half[1], half[2], half[3], result);
}

}  // namespace seine::math
