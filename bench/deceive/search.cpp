#include "bench/deceive/search.hpp"

#include <algorithm>
#include <array>

#include "bench/deceive/mutants.hpp"
#include "seine/certify/certificate.hpp"
#include "seine/world/static_map.hpp"

namespace seine::deceive {
namespace {

constexpr Look kQuick{.hertz = 200.0, .per_piece = 16.0, .least = 4, .most = 200'000};

/// What the search climbs: first towards acceptance, then towards worse faults.
double score(const Verdict& verdict) {
  if (!verdict.accepted) return -1.0 - static_cast<double>(verdict.complaints);
  return std::min(verdict.ratio, 1e12);
}

void finish(Attack& attack) {
  if (attack.verdict.accepted) attack.verdict = judge(attack.best, {});
}

std::array<double, kGenes> varied(const std::array<double, kGenes>& genes, Rng& rng, double step) {
  std::array<double, kGenes> next = genes;
  for (double& gene : next)
    if (rng.below(3) == 0) gene = std::clamp(gene + step * rng.normal(), 0.0, 1.0);
  if (rng.below(4) == 0) next[static_cast<std::size_t>(rng.below(kGenes))] = rng.uniform();
  return next;
}

}  // namespace

Verdict judge(const Case& tried, const Look& look, bool look_always) {
  Verdict verdict;
  const world::StaticMap map(tried.scenario);
  const certify::Certificate certificate =
      certify::certify(tried.scenario, map, tried.plan, {.threads = 1, .deadline = Deadline(20.0)});
  verdict.accepted = certificate.holds;
  verdict.complaints = certificate.violations.size();
  if (!certificate.violations.empty())
    verdict.complaint = std::string(certify::name_of(certificate.violations.front().kind)) + ": " +
                        certificate.violations.front().text;
  if (!verdict.accepted && !look_always) return verdict;
  verdict.faults = look_at(tried.scenario, tried.plan, look);
  verdict.ratio = worst_ratio(verdict.faults);
  return verdict;
}

Attack attack_by(const Construction& construction, Rng& rng, int steps) {
  std::array<double, kGenes> genes{};
  for (double& gene : genes) gene = rng.uniform();
  Attack attack;
  double best = -1e300, step = 0.2;
  for (int i = 0; i <= steps; ++i) {
    const auto next = i == 0 ? genes : varied(genes, rng, step);
    Case tried = construction.build(Genes(next));
    Verdict verdict = judge(tried, kQuick);
    ++attack.tried;
    attack.accepted += verdict.accepted ? 1 : 0;
    const double now = score(verdict);
    step = std::clamp(step * (now > best ? 1.3 : 0.95), 0.005, 0.5);
    if (now < best) continue;
    best = now, genes = next;
    attack.best = std::move(tried), attack.verdict = std::move(verdict);
    if (best > 1.0) break;
  }
  finish(attack);
  return attack;
}

Attack attack_from(const Case& accepted, Rng& rng, int steps) {
  Attack attack{.best = accepted, .verdict = judge(accepted, kQuick)};
  for (int i = 0; i < steps && !(attack.verdict.ratio > 1.0); ++i) {
    Case tried = attack.best;
    mutate(tried, rng);
    Verdict verdict = judge(tried, kQuick);
    ++attack.tried;
    attack.accepted += verdict.accepted ? 1 : 0;
    if (!verdict.accepted || score(verdict) < score(attack.verdict)) continue;
    attack.best = std::move(tried), attack.verdict = std::move(verdict);
  }
  finish(attack);
  return attack;
}

}  // namespace seine::deceive
