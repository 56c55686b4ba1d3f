#include "seine/certify/formation.hpp"

#include <algorithm>
#include <cmath>

#include "seine/net/catch_rules.hpp"

namespace seine::certify {

using geom::Vec2;

namespace {

// Cells of two cars that end this close to each other end one beat: beyond its cell a polynomial is followed
// for so short a time that nothing changes (1e-9 m at 1 m/s of allowed jumps is below rounding).
constexpr double kTogether = 1e-9;  // s

/// The instants at which the phase changes, ascending.
std::vector<double> changes_of(const Phases& phases) {
  std::vector<double> changes{phases.loaded};
  for (const double caught : phases.catches) {
    changes.push_back(caught);
    changes.push_back(caught + net::kHoldTime);
  }
  std::sort(changes.begin(), changes.end());
  return changes;
}

}  // namespace

double Phases::first_catch() const {
  double first = std::numeric_limits<double>::infinity();
  for (const double caught : catches) first = std::min(first, caught);
  return first;
}

double Phases::last_catch() const {
  double last = 0.0;
  for (const double caught : catches) last = std::max(last, caught);
  return last;
}

bool Phases::held(double t) const {
  return std::any_of(catches.begin(), catches.end(),
                     [t](double caught) { return t >= caught && t < caught + net::kHoldTime; });
}

geom::Box Slice::box() const {
  geom::Box box;
  double loss_of_any = 0.0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    box.include(from[k]), box.include(to[k]);
    loss_of_any = std::max(loss_of_any, loss(k));
  }
  return box.inflated(loss_of_any);
}

Formation::Formation(const net::Net& net, std::span<const Mover* const> robots, double horizon,
                     const Phases& phases)
    : robots_(robots.begin(), robots.end()) {
  for (const net::Attachment& attachment : net.attachments) held_at_.push_back(attachment.at);
  const std::vector<double> changes = changes_of(phases);
  std::size_t expected = changes.size();  // beats, unless cells end together
  for (const Mover* robot : robots_) expected += robot->cells.size();
  expected = std::min(expected, kMostBeats);
  beats_.reserve(expected), cells_.reserve(expected * size()), bends_.reserve(expected * size());
  from_.reserve(expected * size()), to_.reserve(expected * size());
  std::vector<std::size_t> at(size(), 0);
  auto change = changes.begin();
  for (double t = 0.0; t < horizon || beats_.empty();) {
    while (change != changes.end() && *change <= t) ++change;
    double until = change != changes.end() ? std::min(*change, horizon) : horizon;
    for (std::size_t k = 0; k < size(); ++k) {
      const auto& cells = robots_[k]->cells;
      while (at[k] + 1 < cells.size() && cells[at[k]].t1 <= t + kTogether) ++at[k];
      if (at[k] + 1 < cells.size()) until = std::min(until, cells[at[k]].t1);
    }
    if (beats_.size() >= kMostBeats) {
      complete_ = false;
      return;
    }
    add_beat(t, until, phases, at);
    t = until;
  }
}

void Formation::add_beat(double t0, double t1, const Phases& phases, std::span<const std::size_t> at) {
  const std::size_t first = cells_.size(), before = first - size();
  beats_.push_back(
      {.t0 = t0, .t1 = t1, .loaded = t0 >= phases.loaded, .held = phases.held(t0), .first = first});
  for (std::size_t k = 0; k < size(); ++k) {
    const Cell* cell = &robots_[k]->cells[at[k]];
    const bool same = first > 0 && cells_[before + k] == cell;
    cells_.push_back(cell);
    bends_.push_back(cell->bend);
    from_.push_back(same ? to_[before + k] : attachment(k, *cell, t0));
    to_.push_back(attachment(k, *cell, t1));
  }
  measure_stray(beats_.back());
}

void Formation::measure_stray(Beat& beat) {
  const Slice now = slice(beat);
  Vec2 common;  // what all move by
  for (std::size_t k = 0; k < size(); ++k) common += now.to[k] - now.from[k];
  common = common / static_cast<double>(size());
  double jump = 0.0, moved = 0.0, loss = 0.0;
  for (std::size_t k = 0; k < size(); ++k) {
    if (beat.first > 0) jump = std::max(jump, geom::squared_norm(now.from[k] - to_[beat.first - size() + k]));
    moved = std::max(moved, geom::squared_norm(now.to[k] - now.from[k] - common));
    loss = std::max(loss, now.loss(k));
  }
  const double before = beats_.size() > 1 ? beats_[beats_.size() - 2].strayed : 0.0;
  beat.strayed = before + std::sqrt(jump) + std::sqrt(moved);
  beat.strayed_within = beat.strayed + loss;
}

Vec2 Formation::attachment(std::size_t k, const Cell& cell, double t) const {
  return to_world(robots_[k]->frame(cell, t), held_at_[k]);
}

Slice Formation::slice(const Beat& beat) const {
  return {&beat,   {bends_.data() + beat.first, size()}, beat.t0,
          beat.t1, {from_.data() + beat.first, size()},  {to_.data() + beat.first, size()}};
}

void Formation::place(const Beat& beat, double t, std::span<Vec2> out) const {
  for (std::size_t k = 0; k < size(); ++k) out[k] = attachment(k, *cells_[beat.first + k], t);
}

}  // namespace seine::certify
