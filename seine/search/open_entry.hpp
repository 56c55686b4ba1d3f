#pragma once

namespace seine::search {

/// A node that waits to be expanded, in a heap of the standard library.
struct OpenEntry {
  double estimate;  ///< of the cost of the whole way through it
  int node;
  // A max-heap's order: the lowest estimate comes first, and the older node of two equal ones.
  friend bool operator<(const OpenEntry& a, const OpenEntry& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.node > b.node;
  }
};

}  // namespace seine::search
