#pragma once

#include <limits>
#include <span>
#include <vector>

#include "seine/certify/mover.hpp"
#include "seine/world/scenario.hpp"

namespace seine::certify {

/// When something lies in the net, and when targets fall into it.
struct Phases {
  double loaded = std::numeric_limits<double>::infinity();  ///< s, from then on; infinite: never
  std::vector<double> catches;                              ///< s, those that happen, any order

  double first_catch() const;  ///< s; infinite when there is none
  double last_catch() const;   ///< s; 0 when there is none
  bool held(double t) const;   ///< whether a catch is so recent that the net must stay wide open
};

/// A stretch of the common clock on which all cars' motions are analytic and the phase does not change.
struct Beat {
  double t0 = 0.0, t1 = 0.0;  ///< s
  bool loaded = false;
  bool held = false;
  std::size_t first = 0;  ///< its entries in the formation's tables begin here, one a car
  /// By how much the shape has changed from t = 0 to the end of the beat at most, m: between the end of an
  /// earlier beat and now every attachment has moved by no more than the difference, but for one translation
  /// of all. `strayed_within`: to any instant of the beat.
  double strayed = 0.0, strayed_within = 0.0;
};

/// A part of a beat with the attachments at its ends.
struct Slice {
  const Beat* beat = nullptr;
  std::span<const double> bends;  ///< upper bounds of the attachments' accelerations on the beat, m/s²
  double t0 = 0.0, t1 = 0.0;      ///< s
  std::span<const geom::Vec2> from, to;

  /// By how much attachment k can leave its chord, m.
  double loss(std::size_t k) const { return chord_loss(bends[k], t1 - t0); }
  /// By how much the vector between two attachments can leave its chord, m.
  double loss(std::size_t i, std::size_t j) const { return chord_loss(bends[i] + bends[j], t1 - t0); }
  /// All attachments stay within it.
  geom::Box box() const;
};

/// The attachments of a net on the common clock: the cells of all cars merged into beats.
class Formation {
 public:
  /// More beats than this are not made; `complete` is false then.
  static constexpr std::size_t kMostBeats = 1u << 17;

  /// @param robots all charted, with the attachment within `reach`; they outlive the formation
  Formation(const net::Net& net, std::span<const Mover* const> robots, double horizon, const Phases& phases);

  std::size_t size() const { return robots_.size(); }
  bool complete() const { return complete_; }
  std::span<const Beat> beats() const { return beats_; }
  /// The whole of a beat.
  Slice slice(const Beat& beat) const;
  /// Attachments at time t of a beat.
  void place(const Beat& beat, double t, std::span<geom::Vec2> out) const;

 private:
  void add_beat(double t0, double t1, const Phases& phases, std::span<const std::size_t> at);
  void measure_stray(Beat& beat);
  geom::Vec2 attachment(std::size_t k, const Cell& cell, double t) const;

  std::vector<const Mover*> robots_;
  std::vector<geom::Vec2> held_at_;  // attachments in the body frames
  std::vector<Beat> beats_;
  std::vector<const Cell*> cells_;  // tables: an entry a car and beat
  std::vector<double> bends_;
  std::vector<geom::Vec2> from_, to_;
  bool complete_ = true;
};

}  // namespace seine::certify
