#include "seine/search/velocity.hpp"

#include <algorithm>
#include <cmath>

namespace seine::search {
namespace {

constexpr int kWordBits = 64;
constexpr int kLayersPerLook = 64;                               // at the clock
constexpr std::size_t kMostWords = std::size_t{256} << 20 >> 3;  // 256 MiB of states

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

bool test(const std::uint64_t* bits, int i) {
  return (bits[i / kWordBits] >> (i % kWordBits) & 1) != 0;
}

// A move is tested at its middle: unit + level, except that leaving rest (0, +1) is tested one unit ahead and
// coming to rest (1, −1) one unit back: units at which a car rests are tested without any slack.
int middle_of(int level, int change) {
  return level == 0 && change == 1 ? 1 : level == 1 && change == -1 ? 0 : level;
}

// The search itself. Layer t holds, for each speed level, the set of units where the car can be at tick 2t:
// only the words between the first and the last in which anything is alive are kept.
class Program {
 public:
  Program(const SpeedLattice& lattice, VelocityWorkspace& workspace, const VelocityOptions& options)
      : lattice_(lattice),
        occupied_(workspace.occupied),
        bits_(workspace.layers),
        layers_(workspace.windows),
        options_(options),
        levels_(lattice.grid().levels),
        words_(lattice.words()) {}

  VelocityPlan run();

 private:
  const std::uint64_t* taken(int tick) const { return occupied_.row(std::min(tick, occupied_.ticks() - 1)); }
  // The words of level k; the word w of the way is at w − layers_[layer].low.
  std::uint64_t* level(int layer, int k) {
    const LayerWindow& window = layers_[idx(layer)];
    return &bits_[window.begin + idx(k) * idx(window.words)];
  }
  bool holds(int layer, int k, int unit) {
    const LayerWindow& window = layers_[idx(layer)];
    const int word = unit / kWordBits - window.low;
    return word >= 0 && word < window.words && (level(layer, k)[word] >> (unit % kWordBits) & 1) != 0;
  }
  bool add_layer(int low, int high);
  bool given_up(int layer) const { return layer % kLayersPerLook == 0 && options_.deadline.expired(); }
  bool advance(int layer);
  void shift_moves(int layer, int k, const std::uint64_t* middle);
  bool stays_free(int tick) const { return tick > last_taken_goal_; }
  std::vector<ProfileKnot> trace_back(int layer, std::vector<int>& tested);
  bool came_from(int layer, int k, int unit, int change);

  const SpeedLattice& lattice_;
  const Occupied& occupied_;
  std::vector<std::uint64_t>& bits_;
  std::vector<LayerWindow>& layers_;
  const VelocityOptions& options_;
  const int levels_, words_;
  int low_ = 0, high_ = 0;  // words in which anything is alive
  bool alive_ = false;
  int last_taken_goal_ = -1;  // tick
};

// The next layer, empty. False: more memory than a velocity plan may have.
bool Program::add_layer(int low, int high) {
  const std::size_t begin = bits_.size(), count = idx(levels_ + 1) * idx(high - low + 1);
  if (begin + count > kMostWords) return false;
  layers_.push_back({begin, low, high - low + 1});
  bits_.resize(begin + count, 0);
  return true;
}

// States at `layer` to states at `layer + 1`.
bool Program::advance(int layer) {
  const int high = std::min(high_ + 1, words_ - 1);
  if (!add_layer(low_, high)) return false;
  const std::uint64_t* middle = taken(2 * layer + 1);
  for (int k = 0; k <= levels_; ++k) shift_moves(layer, k, middle);
  high_ = high;
  const std::uint64_t* then = taken(2 * layer + 2);
  std::uint64_t low_alive = 0, high_alive = 0, any = 0;
  for (int k = 0; k <= levels_; ++k) {
    std::uint64_t* row = level(layer + 1, k);
    for (int w = low_; w <= high_; ++w) any |= row[w - low_] &= ~then[w];
    low_alive |= row[0];
    high_alive |= row[high_ - low_];
  }
  alive_ = any != 0;
  if (low_alive == 0 && low_ < high_) ++low_;
  if (high_alive == 0 && low_ < high_) --high_;
  return true;
}

void Program::shift_moves(int layer, int k, const std::uint64_t* middle) {
  const LayerWindow &window = layers_[idx(layer)], &next = layers_[idx(layer + 1)];
  const std::uint64_t* from = level(layer, k);
  int low = low_, high = std::min(high_, window.low + window.words - 1);
  while (low <= high && from[low - window.low] == 0) ++low;
  while (low <= high && from[high - window.low] == 0) --high;
  if (low > high) return;
  for (int j = -1; j <= 1; ++j) {
    if (k + j < 0 || k + j > levels_) continue;
    const int ahead = middle_of(k, j), shift = 2 * k + j;
    const std::uint64_t* allowed = lattice_.moves(k, j);
    std::uint64_t* into = level(layer + 1, k + j);
    std::uint64_t carry = 0;
    for (int w = low; w <= high; ++w) {
      std::uint64_t blocked = middle[w] >> ahead;
      if (ahead > 0) blocked |= middle[w + 1] << (kWordBits - ahead);  // rows are padded
      const std::uint64_t moved = from[w - window.low] & allowed[w] & ~blocked;
      into[w - next.low] |= moved << shift | carry;
      carry = shift > 0 ? moved >> (kWordBits - shift) : 0;
    }
    if (high + 1 < next.low + next.words) into[high + 1 - next.low] |= carry;
  }
}

VelocityPlan Program::run() {
  VelocityPlan plan;
  const int goal = lattice_.units(), first = lattice_.start_step();
  for (int q = occupied_.ticks() - 1; q >= 0 && last_taken_goal_ < 0; --q)
    if (test(occupied_.row(q), goal)) last_taken_goal_ = q;
  if (last_taken_goal_ == occupied_.ticks() - 1) return plan;  // taken for good
  bits_.clear();
  layers_.clear();
  for (int layer = 0; layer <= first; ++layer) add_layer(0, 0);
  if (!test(taken(0), 0) && !test(taken(first), 0) && !test(taken(2 * first), 0))
    *level(first, lattice_.start_level()) = 1;
  alive_ = *level(first, lattice_.start_level()) != 0;
  for (int layer = first; 2 * layer <= options_.ticks && !given_up(layer); ++layer) {
    if (holds(layer, 0, goal) && stays_free(2 * layer)) {
      plan.found = true;
      plan.tested.assign(idx(2 * layer + 1), 0);
      plan.profile = trace_back(layer, plan.tested);
      plan.arrival = plan.profile.back().t;
      return plan;
    }
    // What lies further back cannot make it in time even alone.
    low_ = std::max(low_, lattice_.hopeless(options_.ticks - 2 * layer) / kWordBits);
    if (!alive_ || low_ > high_ || !advance(layer)) break;
  }
  return plan;
}

// Whether the state (k, unit) at `layer + 1` was reached by `change` from `layer`.
bool Program::came_from(int layer, int k, int unit, int change) {
  const int before = k - change, from = unit - 2 * before - change;
  if (before < 0 || before > levels_ || from < 0) return false;
  if (!holds(layer, before, from) || !test(lattice_.moves(before, change), from)) return false;
  return !test(taken(2 * layer + 1), from + middle_of(before, change));
}

// Backwards in time the car goes as fast as it can: it leaves as late as possible.
std::vector<ProfileKnot> Program::trace_back(int layer, std::vector<int>& tested) {
  std::vector<ProfileKnot> knots;
  int unit = lattice_.units(), k = 0;
  const double step = lattice_.grid().step;
  const auto knot = [&](int at) {
    return ProfileKnot{at * step, lattice_.s_at(unit), lattice_.speed_at(unit, k)};
  };
  constexpr int kStanding = 2;  // beside the changes −1, 0, 1
  int last_phase = 3;
  for (; layer > lattice_.start_step(); --layer) {
    int change = -1;
    while (change < 1 && !came_from(layer - 1, k, unit, change)) ++change;
    const int phase = k == 0 && change == 0 ? kStanding : change;
    if (phase != last_phase) knots.push_back(knot(layer));
    last_phase = phase;
    tested[idx(2 * layer)] = unit;
    k -= change;
    unit -= 2 * k + change;
    tested[idx(2 * layer - 1)] = unit + middle_of(k, change);
  }
  knots.push_back(knot(layer));
  if (lattice_.start_step() > 0) knots.push_back({0.0, 0.0, lattice_.start_speed()});
  std::reverse(knots.begin(), knots.end());
  return knots;
}

}  // namespace

namespace {

// Adds the groups of one chunk that meet one event, neighbours as one mark.
void mark_event(const SpeedLattice& lattice, const SpeedLattice::Chunk& groups, const MovingBody& body, int e,
                double clearance, int furthest, std::vector<Mark>& marks) {
  const MovingBody::Event& event = body.events()[idx(e)];
  const geom::Box near = event.box.inflated(clearance);
  for (int g = groups.first; g < groups.last; ++g) {
    const SpeedLattice::Group& group = lattice.groups()[idx(g)];
    if (group.first > furthest) return;
    if (!group.box.overlaps(near) || apart(lattice, idx(g), body, idx(e), clearance)) continue;
    if (!marks.empty() && marks.back().begin == event.begin && marks.back().last + 1 == group.first)
      marks.back().last = group.last;
    else
      marks.push_back({event.begin, event.end, group.first, group.last});
  }
}

// Sets the bits [first, last].
void set_range(std::uint64_t* bits, int first, int last) {
  for (int w = first / kWordBits; w <= last / kWordBits; ++w) {
    const int low = std::max(first - w * kWordBits, 0), high = std::min(last - w * kWordBits, kWordBits - 1);
    bits[w] |= (~std::uint64_t{0} >> (kWordBits - 1 - high)) & (~std::uint64_t{0} << low);
  }
}

}  // namespace

std::vector<Mark> marks_of(const SpeedLattice& lattice, const MovingBody& body, double clearance,
                           std::span<const int> reach) {
  std::vector<Mark> marks;
  const geom::Box all = body.box().inflated(clearance);
  if (!all.overlaps(lattice.box())) return marks;
  // Even at the end of its time the car cannot be beyond this unit.
  const auto furthest = [&](int end) {
    return idx(end) <= reach.size() ? reach[idx(end) - 1] : lattice.units();
  };
  for (const SpeedLattice::Chunk& groups : lattice.chunks()) {
    if (!groups.box.overlaps(all)) continue;
    const geom::Box around = groups.box.inflated(clearance);
    const int first = lattice.groups()[idx(groups.first)].first;
    for (const MovingBody::Chunk& events : body.chunks()) {
      if (!events.box.overlaps(around) || furthest(events.end) < first) continue;
      for (int e = events.first; e < events.last; ++e) {
        const MovingBody::Event& event = body.events()[idx(e)];
        if (event.box.overlaps(around))
          mark_event(lattice, groups, body, e, clearance, furthest(event.end), marks);
      }
    }
  }
  return marks;
}

void Occupied::reset(const SpeedLattice& lattice, int ticks) {
  ticks_ = std::max(ticks, 1);
  stride_ = idx(lattice.words() + 1);
  bits_.assign(idx(ticks_) * stride_, 0);
  lasting_.clear();
}

void Occupied::add(std::span<const Mark> marks) {
  for (const Mark& mark : marks) {
    if (mark.end == MovingBody::kForever) {
      lasting_.push_back(mark);
      lasting_.back().begin = std::min(mark.begin, ticks_ - 1);
      continue;
    }
    // What is later than the last row belongs to it.
    for (int q = std::min(mark.begin, ticks_ - 1); q < std::min(mark.end, ticks_); ++q)
      set_range(&bits_[idx(q) * stride_], mark.first, mark.last);
  }
}

void Occupied::finish() {
  std::sort(lasting_.begin(), lasting_.end(), [](const Mark& a, const Mark& b) { return a.begin < b.begin; });
  std::vector<std::uint64_t> sum(stride_, 0);
  std::size_t next = 0;
  for (int q = lasting_.empty() ? ticks_ : lasting_.front().begin; q < ticks_; ++q) {
    for (; next < lasting_.size() && lasting_[next].begin <= q; ++next)
      set_range(sum.data(), lasting_[next].first, lasting_[next].last);
    for (std::size_t w = 0; w < stride_; ++w) bits_[idx(q) * stride_ + w] |= sum[w];
  }
}

bool apart(const SpeedLattice& lattice, std::size_t group, const MovingBody& body, std::size_t event,
           double clearance) {
  return apart(lattice.groups()[group].turned, lattice.polygon(group), lattice.boxes(), body,
               static_cast<int>(event), clearance);
}

VelocityPlan plan_velocity(const SpeedLattice& lattice, VelocityWorkspace& workspace,
                           const VelocityOptions& options) {
  if (!lattice.drivable()) return {};
  return Program(lattice, workspace, options).run();
}

}  // namespace seine::search
