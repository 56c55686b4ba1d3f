#include "seine/search/speed_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace seine::search {
namespace {

constexpr int kWordBits = 64;
constexpr int kGroupUnits = 4;
constexpr int kChunkGroups = 8;
constexpr double kMostUnits = 2e6;  // of a stretch: finer than any way needs
// A move tested at its middle may have reached a quarter unit further than its integer place, and within the
// quarter step before and after the test the half level it gains or loses: 1/4 + 1/4 + 1/16 units on top of
// level / 2.
constexpr double kMoveSlack = 0.5625;

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

void set_bit(std::uint64_t* bits, int i) {
  bits[i / kWordBits] |= std::uint64_t{1} << (i % kWordBits);
}

// into &= bits >> shift, 0 ≤ shift < 64.
void and_shifted(std::uint64_t* into, const std::uint64_t* bits, int shift, int words) {
  for (int w = 0; w < words; ++w) {
    std::uint64_t value = bits[w] >> shift;
    if (shift > 0 && w + 1 < words) value |= bits[w + 1] << (kWordBits - shift);
    into[w] &= value;
  }
}

}  // namespace

SpeedGrid speed_grid(const vehicle::Model& model, const LatticeOptions& options) {
  constexpr int kFewestLevels = 4, kMostLevels = 10;
  // Units smaller than this share of a car's length only cost time; an acceleration that asks for them is not
  // used in full.
  constexpr double kFinest = 1.0 / 200.0;
  const double length = model.length();
  const vehicle::Limits& limits = model.limits;
  SpeedGrid grid;
  grid.acceleration = options.acceleration_factor * limits.acceleration;
  if (!std::isfinite(grid.acceleration)) grid.acceleration = 100.0 * length;
  grid.speed = std::min(options.speed_factor * limits.speed, std::sqrt(100.0 * length * grid.acceleration));
  grid.acceleration = std::min(
      grid.acceleration, grid.speed * grid.speed / (2.0 * kFewestLevels * kFewestLevels * kFinest * length));
  if (options.least_unit > 0.0)
    grid.acceleration =
        std::min(grid.acceleration,
                 grid.speed * grid.speed / (2.0 * kFewestLevels * kFewestLevels * options.least_unit));
  grid.reverse_speed = std::min(options.speed_factor * limits.reverse_speed, grid.speed);
  grid.lateral = options.lateral_factor * limits.lateral_acceleration;
  const double wanted = grid.speed / std::sqrt(2.0 * grid.acceleration * length / options.units_per_length);
  grid.levels = static_cast<int>(std::lround(std::clamp<double>(wanted, kFewestLevels, kMostLevels)));
  grid.step = grid.speed / (grid.levels * grid.acceleration);
  grid.unit = 0.5 * grid.acceleration * grid.step * grid.step;
  return grid;
}

SpeedLattice::SpeedLattice(Path path, const SpeedGrid& grid, const SweptFootprint& footprint,
                           double start_speed, bool careful)
    : path_(std::move(path)),
      grid_(grid),
      careful_(careful),
      corners_(footprint.corners()),
      boxes_(footprint.is_box()) {
  cut_stretches(start_speed);
  if (!drivable_) return;
  words_ = units_ / kWordBits + 1;
  limit_speeds();
  reach_speeds();
  if (!drivable_) return;
  build_moves();
  build_groups(footprint);
}

void SpeedLattice::cut_stretches(double start_speed) {
  const std::vector<PathPoint>& p = path_.points;
  start_speed_ = std::abs(start_speed);
  stub_ = start_speed_ > 0.0;
  if (p.empty() || (stub_ && (start_speed > 0.0) != (p.front().gear > 0))) {
    drivable_ = false;
    return;
  }
  start_level_ = std::min(grid_.levels, static_cast<int>(start_speed_ / (grid_.acceleration * grid_.step)));
  std::size_t from = 0;
  for (std::size_t i = 1; i <= p.size() && drivable_; ++i) {
    const bool goes_on = i < p.size() && p[i].gear == p[from].gear;
    const bool rests = goes_on && std::ranges::binary_search(path_.rests, p[i].s);
    if (goes_on && !rests) continue;
    const double slowest = p[from].gear > 0 ? grid_.speed : grid_.reverse_speed;
    const double end = p[rests ? i : i - 1].s;
    constexpr double kNothing = 1e-9;
    if (end - p[from].s > kNothing) drivable_ = add_stretch(p[from].s, end, p[from].gear, slowest);
    drivable_ = drivable_ && units_ < kMostUnits;
    from = i;
  }
  if (stretches_.empty()) {  // it stands where it is going
    if (stub_) drivable_ = false;
    s_ = {0.0};
  }
}

bool SpeedLattice::add_stretch(double begin, double end, int gear, double slowest) {
  const bool moving = stub_ && s_.empty();
  const double unit = std::min(grid_.unit, 0.5 * slowest * grid_.step);
  if (!(unit > 0.0)) return false;
  // A car that moves takes one step to come from its speed to level k, over a stub of ½ (v + k · 2 unit /
  // step) · step: what is left is (count + k) units.
  const int level = moving ? start_level_ : 0, parity = level % 2;
  const double stub = moving ? 0.5 * start_speed_ * grid_.step : 0.0;
  const double length = end - begin - stub;
  constexpr double kRounding = 1e-9;
  if (moving && level == 0 && std::abs(length) <= kRounding) {  // it stops at the end of its stub
    s_.push_back(end);
    return true;
  }
  if (length <= 0.0 || !(length < kMostUnits * unit)) return false;
  const double units = std::max(0.0, length / unit - level);
  int count = 2 * static_cast<int>(std::ceil((units - parity) / 2.0 - 1e-9)) + parity;
  count = std::max({count, 2 - parity, level * level});  // k² units to stop from level k
  const double scaled = length / (count + level);
  begin += stub + level * scaled;
  if (s_.empty()) s_.push_back(begin);
  stretches_.push_back({units_, units_ + count, begin, scaled, gear});
  for (int i = 1; i <= count; ++i) s_.push_back(begin + (end - begin) * i / count);
  units_ += count;
  return true;
}

void SpeedLattice::limit_speeds() {
  curvature_.assign(idx(units_ + 1), 0.0);
  allowed_.assign(idx(units_ + 1), 0.0);
  const std::vector<PathPoint>& p = path_.points;
  std::size_t i = 0;
  for (const Stretch& stretch : stretches_) {
    const double end = s_at(stretch.last);
    for (; i + 1 < p.size() && p[i].s < end - 1e-12; ++i) {
      const double from = (p[i].s - stretch.begin) / stretch.unit,
                   to = (p[i + 1].s - stretch.begin) / stretch.unit;
      if (to < 0.0) continue;
      const int low = stretch.first + std::max(0, static_cast<int>(from) - 1);
      const int high = std::min(stretch.last, stretch.first + static_cast<int>(to) + 2);
      for (int b = low; b <= high; ++b)
        curvature_[idx(b)] = std::max(curvature_[idx(b)], std::abs(p[i].curvature));
    }
    const double top = stretch.gear > 0 ? grid_.speed : grid_.reverse_speed;
    const double level_speed = 2.0 * stretch.unit / grid_.step;
    for (int b = stretch.first + 1; b < stretch.last; ++b) {
      double speed = top;
      if (std::isfinite(grid_.lateral) && curvature_[idx(b)] > 0.0)
        speed = std::min(speed, std::sqrt(grid_.lateral / curvature_[idx(b)]));
      // One level must always be allowed, or the car could not move at all.
      allowed_[idx(b)] = std::clamp<double>(speed / level_speed, 1.0, grid_.levels);
    }
  }
  if (careful_) slow_in_bends();
  // A car that starts moving may always brake, whatever the first bend allows.
  const int braking = std::min(start_level_ * start_level_, units_);
  for (int b = 0; b < braking; ++b)
    allowed_[idx(b)] = std::max(allowed_[idx(b)], std::ceil(std::sqrt(start_level_ * start_level_ - b)));
}

// A body point at a distance r from the rear axle moves sideways by κr for every metre driven, and a test
// stands for half a level's units to either side.
void SpeedLattice::slow_in_bends() {
  constexpr double kSideways = 0.05;  // of r
  for (double& level : allowed_) {
    const double curvature = curvature_[static_cast<std::size_t>(&level - allowed_.data())];
    const double drift = kSideways / (std::max(curvature, 1e-9) * grid_.unit);
    if (level > 1.0) level = std::clamp(2.0 * (drift - kMoveSlack), 1.0, level);
  }
}

void SpeedLattice::reach_speeds() {
  attainable2_.resize(idx(units_ + 1));
  attainable2_[0] = allowed_[0] * allowed_[0];
  for (int b = 1; b <= units_; ++b)
    attainable2_[idx(b)] = std::min(allowed_[idx(b)] * allowed_[idx(b)], attainable2_[idx(b - 1)] + 1.0);
  for (int b = units_ - 1; b >= 0; --b)
    attainable2_[idx(b)] = std::min(attainable2_[idx(b)], attainable2_[idx(b + 1)] + 1.0);
  if (attainable2_[0] < start_level_ * start_level_ - 1e-9) drivable_ = false;
  left_.assign(idx(units_ + 1), 0.0);
  for (int b = units_ - 1; b >= 0; --b) left_[idx(b)] = left_[idx(b + 1)] + quickest_over(b);
}

// Ticks from unit b to the next: from level k to level m over one unit takes 1 / (k + m) time steps at
// constant acceleration.
double SpeedLattice::quickest_over(int b) const {
  return 2.0 / (std::sqrt(attainable2_[idx(b)]) + std::sqrt(attainable2_[idx(b + 1)]));
}

int SpeedLattice::hopeless(int ticks) const {
  constexpr double kRounding = 1e-6;
  const auto first = std::partition_point(
      left_.begin(), left_.end(), [&](double left) { return left > (1.0 + kRounding) * ticks + kRounding; });
  return static_cast<int>(first - left_.begin());
}

// Tests look one unit ahead at most.
std::vector<int> SpeedLattice::reach() const {
  std::vector<int> furthest;
  double tick = 2.0 * start_step();
  for (int b = 0; b < units_; ++b) {
    tick += quickest_over(b);
    while (static_cast<double>(furthest.size()) < tick) furthest.push_back(std::min(b + 1, units_));
  }
  return furthest;
}

void SpeedLattice::build_moves() {
  const int levels = grid_.levels;
  const auto row = [this](std::vector<std::uint64_t>& bits, int r) { return &bits[idx(r * words_)]; };
  // at_least[h]: units where h/2 levels are allowed; state[k]: units where level k is allowed and can be
  // reached and left.
  std::vector<std::uint64_t> at_least(idx((2 * levels + 1) * words_)), state(idx((levels + 1) * words_));
  constexpr double kRound = 1e-9;
  for (int b = 0; b <= units_; ++b) {
    set_bit(row(at_least, static_cast<int>(2.0 * allowed_[idx(b)] + kRound)), b);
    set_bit(row(state, static_cast<int>(std::sqrt(attainable2_[idx(b)]) + kRound)), b);
  }
  const auto accumulate = [&](std::vector<std::uint64_t>& bits, int top) {
    for (int r = top - 1; r >= 0; --r)
      for (int w = 0; w < words_; ++w) row(bits, r)[w] |= row(bits, r + 1)[w];
  };
  accumulate(at_least, 2 * levels);
  accumulate(state, levels);
  moves_.assign(idx((levels + 1) * 3 * words_), 0);
  for (int k = 0; k <= levels; ++k)
    for (int j = -1; j <= 1; ++j) {
      if (k + j < 0 || k + j > levels) continue;
      std::uint64_t* mask = &moves_[idx((k * 3 + j + 1) * words_)];
      std::copy_n(row(state, k), words_, mask);
      and_shifted(mask, row(state, k + j), 2 * k + j, words_);
      // Between the ends the speed is √(k² + jx): bounded by half levels, v² = k² ± x against (k ± ½)².
      for (int x = 1; x < 2 * k + j; ++x) {
        const int half_levels = j == 0  ? 2 * k
                                : j > 0 ? (x <= k ? 2 * k + 1 : 2 * k + 2)
                                        : (x < k ? 2 * k : 2 * k - 1);
        and_shifted(mask, row(at_least, half_levels), x, words_);
      }
    }
}

void SpeedLattice::build_groups(const SweptFootprint& footprint) {
  PathCursor cursor(path_);
  const std::size_t expected = idx(units_ / kGroupUnits + 3);
  groups_.reserve(expected);
  polygons_.reserve(expected * corners_);
  add_group(footprint, 0, 0, cursor);
  const int together = careful_ ? 1 : kGroupUnits;
  for (int b = 1; b < units_; b += together)
    add_group(footprint, b, std::min(b + together - 1, units_ - 1), cursor);
  if (units_ > 0) add_group(footprint, units_, units_, cursor);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (g % kChunkGroups == 0) chunks_.push_back({{}, static_cast<int>(g), static_cast<int>(g)});
    chunks_.back().last = static_cast<int>(g) + 1;
    chunks_.back().box.include(groups_[g].box.low);
    chunks_.back().box.include(groups_[g].box.high);
  }
  for (const Chunk& chunk : chunks_) {
    box_.include(chunk.box.low);
    box_.include(chunk.box.high);
  }
}

void SpeedLattice::add_group(const SweptFootprint& footprint, int first, int last, PathCursor& cursor) {
  const double middle = 0.5 * (s_at(first) + s_at(last));
  const geom::Pose2 pose = cursor.advance(middle);
  Slack slack;
  const bool resting = first == last && ((first == 0 && !stub_) || first == units_ ||
                                         (careful_ && attainable2_[idx(first)] == 0.0));
  if (!resting) {
    double level2 = 0.0;
    for (int b = first; b <= last; ++b) level2 = std::max(level2, attainable2_[idx(b)]);
    const double drift = 0.5 * std::sqrt(level2) + kMoveSlack;
    slack.ahead = slack.behind = 0.5 * (s_at(last) - s_at(first)) + drift * grid_.unit;
    if (first == 0) slack.behind += s_at(0);  // the braking step of a moving start
    if (careful_) stay_on_the_way(first, last, middle, slack);
    const int around = static_cast<int>(drift) + 1;
    for (int b = std::max(0, first - around); b <= std::min(units_, last + around); ++b)
      slack.curvature = std::max(slack.curvature, curvature_[idx(b)]);
  }
  polygons_.resize(polygons_.size() + corners_);
  const std::span<geom::Vec2> out(&polygons_[polygons_.size() - corners_], corners_);
  const OrientedBox turned = footprint.cover(pose, slack, out);
  groups_.push_back({first, last, geom::bounding_box(out), turned});
}

// The car is never before its start nor beyond its goal: what stands there at the margin is not in its way.
void SpeedLattice::stay_on_the_way(int first, int last, double middle, Slack& slack) const {
  if (first >= stretches_.back().first) {
    double& onwards = stretches_.back().gear > 0 ? slack.ahead : slack.behind;
    onwards = std::min(onwards, path_.length() - middle);
  }
  if (last <= stretches_.front().last) {
    double& back = stretches_.front().gear > 0 ? slack.behind : slack.ahead;
    back = std::min(back, middle);
  }
}

double SpeedLattice::speed_at(int unit, int level) const {
  if (level == 0) return 0.0;
  const auto stretch =
      std::find_if(stretches_.begin(), stretches_.end(), [&](const Stretch& s) { return unit <= s.last; });
  return level * 2.0 * stretch->unit / grid_.step;
}

}  // namespace seine::search
