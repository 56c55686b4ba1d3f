#pragma once

#include "seine/certify/formation.hpp"

// What the attachments do throughout a slice, from where they are at its ends. Each vector between two of
// them is its chord plus at most ⅛ (sum of both bends) w², and all bounds below follow from that
// (docs/certificate.md).
namespace seine::certify {

/// An upper bound of the distance of attachments i and j, m.
double furthest_apart(const Slice& slice, std::size_t i, std::size_t j);

/// A lower bound of its square, m².
double least_square_apart(const Slice& slice, std::size_t i, std::size_t j);

/// Whether `other` provably stays at least `by` (m) on the left of the line from attachment i to j.
bool stays_inside(const Slice& slice, std::size_t i, std::size_t j, std::size_t other, double by);

/// An upper bound of (a_i − a_k)·(a_j − a_k), m².
double largest_dot(const Slice& slice, std::size_t i, std::size_t j, std::size_t k);

/// A lower bound of the (signed) area of the attachments' polygon, m².
double least_area(const Slice& slice);

}  // namespace seine::certify
