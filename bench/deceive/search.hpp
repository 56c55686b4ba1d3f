#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/deceive/construction.hpp"
#include "bench/deceive/truth.hpp"
#include "seine/base/rng.hpp"

namespace seine::deceive {

/// What the certificate said of a case, and what is true.
struct Verdict {
  bool accepted = false;
  std::size_t complaints = 0;  ///< of the certificate
  std::string complaint;       ///< the first
  std::vector<Fault> faults;   ///< by the look; only looked for where asked
  double ratio = 0.0;          ///< worst_ratio of them
};

/// @param look_always also at what is refused
Verdict judge(const Case& tried, const Look& look, bool look_always = false);

/// Lets the enemy try with a seed: a construction with random genes, or a certified plan, and so many steps
/// of a search that makes the true fault worse while the certificate accepts.
struct Attack {
  Case best;
  Verdict verdict;   ///< of `best`, by a fine look
  int tried = 0;     ///< cases
  int accepted = 0;  ///< by the certificate
  bool deceived() const { return verdict.accepted && verdict.ratio > 1.0; }
};

/// From genes of one construction.
Attack attack_by(const Construction& construction, Rng& rng, int steps);
/// From a case that is accepted as it stands.
Attack attack_from(const Case& accepted, Rng& rng, int steps);

}  // namespace seine::deceive
