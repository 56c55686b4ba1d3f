#pragma once

#include <vector>

#include "seine/traj/drive.hpp"

namespace seine::certify {

/// A part of a progress piece that lies on one curve piece. What is driven on it is analytic.
struct Chunk {
  std::size_t curve_piece = 0;
  double from = 0.0, to = 1.0;  ///< local parameters of the progress piece
  /// +1: u never decreases, −1: u never increases, so that it stays between its values at both ends. 0: u may
  /// do either, but stays within `still` of its middle value.
  int direction = 1;
  double backwards = 0.0;   ///< how far u goes back on it, at most
  double knot_near = -1.0;  ///< the inner knot that u may pass on it, both ways; negative: none
  /// Where u never goes both ways: the inner knots that its ends may lie beyond, by less than `still`.
  double knot_from = -1.0, knot_to = -1.0;
};

/// The largest |p'| on a curve piece: not below the true one, and less than twice as large for sane pieces.
double longest_tangent(const std::array<traj::Quintic, 2>& piece);

/// Cuts progress piece `j` of a segment where u turns round and where it passes a knot of the curve: the
/// signs of u̇ are read off its Bernstein coefficients, which enclose it [Farouki12], and where they differ
/// the interval is halved. @param still u: what moves less than this need not be cut further
/// @param chunks is overwritten
void chunks_of(const traj::Segment& segment, std::size_t j, double still, std::vector<Chunk>& chunks);

}  // namespace seine::certify
