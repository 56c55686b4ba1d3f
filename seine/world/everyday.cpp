#include "seine/world/everyday.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "seine/base/rng.hpp"

namespace seine::world {
namespace {

using geom::Pose2;
using geom::Vec2;

constexpr double kPi = std::numbers::pi;

struct Named {
  Everyday kind;
  const char* name;
};
constexpr std::array kNames{
    Named{Everyday::open, "open"},
    Named{Everyday::near, "near"},
    Named{Everyday::forward_only, "forward-only"},
    Named{Everyday::slalom, "slalom"},
    Named{Everyday::parallel, "parallel"},
    Named{Everyday::garage, "garage"},
    Named{Everyday::door, "door"},
    Named{Everyday::pocket, "pocket"},
    Named{Everyday::lot, "lot"},
    Named{Everyday::rolling, "rolling"},
    Named{Everyday::moving, "moving"},
    Named{Everyday::pair, "pair"},
};

/// One task in the making, and the lengths it is made of.
class Maker {
 public:
  Maker(Everyday kind, const vehicle::Model& vehicle, std::uint64_t seed);
  Scenario make();

 private:
  void open();
  void near();
  void forward_only();
  void slalom();
  void parallel();
  void garage();
  void door();
  void pocket();
  void lot();
  void rolling();
  void moving();
  void pair();

  void field(double half) { scenario_.bounds = {{-half, -half}, {half, half}}; }
  void box(Vec2 low, Vec2 high);
  /// A parked vehicle of the same size, its body's middle at `middle`.
  void parked(Vec2 middle, bool upright);
  void robot(const Pose2& start, const Pose2& goal, double speed = 0.0);
  /// The pose at which the middle of the body is at `middle`.
  Pose2 centred(Vec2 middle, double heading) const {
    const Vec2 axle = middle - ahead_ * geom::unit(heading);
    return {axle.x, axle.y, heading};
  }
  void swap_in_lane();
  void swap_through_door();

  Everyday kind_;
  vehicle::Model model_;
  Rng rng_;
  Scenario scenario_;
  double L, W, R;  // m
  double margin_;  // m
  double ahead_;   // m, from the rear axle to the middle of the body
  double stop_;    // m, braking distance from full speed
};

Maker::Maker(Everyday kind, const vehicle::Model& vehicle, std::uint64_t seed)
    : kind_(kind), model_(vehicle), rng_(1000 * seed + 37 * static_cast<std::uint64_t>(kind)) {
  const geom::Box body = geom::bounding_box(vehicle.footprint);
  L = body.size().x, W = body.size().y, R = 1.0 / vehicle.max_curvature();
  margin_ = 0.03 * W;
  ahead_ = 0.5 * (body.low.x + body.high.x);
  stop_ = vehicle.limits.speed * vehicle.limits.speed / (2.0 * vehicle.limits.acceleration);
  scenario_.name = std::string(name_of(kind)) + "-" + vehicle.name + "-" + std::to_string(seed);
  scenario_.margins = {margin_, margin_};
}

void Maker::box(Vec2 low, Vec2 high) {
  scenario_.obstacles.push_back({.name = "obstacle " + std::to_string(scenario_.obstacles.size() + 1),
                                 .shape = std::vector<Vec2>{low, {high.x, low.y}, high, {low.x, high.y}}});
}

void Maker::parked(Vec2 middle, bool upright) {
  const Vec2 half = upright ? Vec2{0.5 * W, 0.5 * L} : Vec2{0.5 * L, 0.5 * W};
  box(middle - half, middle + half);
}

void Maker::robot(const Pose2& start, const Pose2& goal, double speed) {
  scenario_.robots.push_back({.name = "car" + std::to_string(scenario_.robots.size()),
                              .start = start,
                              .start_speed = speed,
                              .goal = goal});
}

void Maker::open() {
  const double furthest = 10.0 * L + 4.0 * stop_;
  field(furthest + 4.0 * R + 2.0 * L);
  const double way = rng_.uniform(0.5 * L, furthest);
  const Vec2 goal = way * geom::unit(rng_.uniform(-kPi, kPi));
  robot({0.0, 0.0, rng_.uniform(-kPi, kPi)}, {goal.x, goal.y, rng_.uniform(-kPi, kPi)});
}

void Maker::near() {
  field(4.0 * (L + R));
  constexpr std::array kSteps{0.0, 1e-12, 1e-6, 1e-4, 1e-3, 1e-2};  // m
  const int step = rng_.below(static_cast<int>(kSteps.size()) + 2);
  const double length = step < static_cast<int>(kSteps.size()) ? kSteps[static_cast<std::size_t>(step)]
                                                               : rng_.uniform(0.02, 1.0) * L;
  constexpr std::array kSides{0.0, kPi, 0.5 * kPi, -0.5 * kPi};
  const Vec2 goal = length * geom::unit(kSides[static_cast<std::size_t>(rng_.below(4))]);
  constexpr std::array kTurns{0.0, 0.0, 1e-6, kPi / 180.0, 10.0 * kPi / 180.0};
  robot({0.0, 0.0, 0.0}, {goal.x, goal.y, kTurns[static_cast<std::size_t>(rng_.below(5))]});
}

void Maker::forward_only() {
  model_.limits.reverse_speed = 0.0;
  field(8.0 * (L + R));
  if (rng_.uniform() < 0.3) {
    robot({0.0, 0.0, 0.0}, {rng_.uniform(-2.0, 2.0) * L, rng_.uniform(-3.0, 3.0) * R, kPi});
    return;
  }
  const Vec2 goal = rng_.uniform(0.3, 6.0) * L * geom::unit(rng_.uniform(-kPi, kPi));
  robot({0.0, 0.0, 0.0}, {goal.x, goal.y, rng_.uniform(-kPi, kPi)});
}

void Maker::slalom() {
  const int pillars = 3 + rng_.below(4);
  const double apart = (1.2 * R + L) * rng_.uniform(0.9, 1.5);
  for (int i = 0; i < pillars; ++i) {
    const Vec2 middle{apart * (i + 1), (i % 2 == 0 ? 0.4 : -0.4) * W * rng_.uniform(0.5, 1.5)};
    scenario_.obstacles.push_back(
        {.name = "pillar " + std::to_string(i + 1), .shape = Circle{middle, 0.3 * W}});
  }
  const double end = apart * (pillars + 1);
  scenario_.bounds = {{-2.0 * L, -2.0 * (R + W)}, {end + 2.0 * L, 2.0 * (R + W)}};
  const bool backwards = model_.limits.reverse_speed > 0.3 * model_.limits.speed && rng_.uniform() < 0.2;
  if (backwards)
    robot(centred({end, 0.0}, 0.0), centred({0.0, 0.0}, 0.0));
  else
    robot(centred({0.0, 0.0}, 0.0), centred({end, 0.0}, 0.0));
}

void Maker::parallel() {
  const double slot = rng_.uniform(1.4, 1.6) * L, lane = 1.35 * W, road = 2.6 * W + 0.5 * R;
  const double kerb = -0.5 * W - margin_ - 0.1 * W;
  const double reach = 5.0 * L + R;
  scenario_.bounds = {{-reach, kerb}, {reach, kerb + road + W}};
  parked({-0.5 * (slot + L), 0.0}, false);
  parked({0.5 * (slot + L), 0.0}, false);
  const Pose2 inside = centred({rng_.uniform(-0.1, 0.1) * L, 0.0}, 0.0);
  const int variant = rng_.below(4);
  const Pose2 ahead = centred({1.3 * L, lane}, 0.0), behind = centred({-2.5 * L, lane}, 0.0);
  if (variant == 0) robot(ahead, inside);
  if (variant == 1) robot(behind, inside);
  if (variant == 2) robot(centred({-4.0 * L, lane + 0.3 * W}, rng_.uniform(-0.1, 0.1)), inside);
  if (variant == 3) robot(inside, ahead);
}

void Maker::garage() {
  const double half = 0.5 * W + rng_.uniform(0.055, 0.09) * W, depth = 1.2 * L, wall = 0.2 * W;
  const double apron = 2.0 * R + 1.5 * L;
  scenario_.bounds = {{-apron, -depth - wall}, {apron, apron}};
  box({-half - wall, -depth}, {-half, 0.0});
  box({half, -depth}, {half + wall, 0.0});
  box({-half - wall, -depth - wall}, {half + wall, -depth});
  const bool nose_first = rng_.uniform() < 0.5;
  const Pose2 inside = centred({0.0, -0.5 * depth}, nose_first ? -0.5 * kPi : 0.5 * kPi);
  const Vec2 middle{rng_.uniform(-0.5, 0.5) * apron, rng_.uniform(0.4, 0.6) * apron};
  const Pose2 outside = centred(middle, rng_.uniform(-kPi, kPi));
  if (rng_.uniform() < 0.3)
    robot(inside, outside);
  else
    robot(outside, inside);
}

void Maker::door() {
  const bool closed = rng_.below(8) == 0;
  const double play = closed ? -rng_.uniform(0.1, 0.5) * W : rng_.uniform(0.0075, 0.1) * W;
  const double half = 0.5 * W + margin_ + 0.5 * play, thick = rng_.uniform(0.05, 1.0) * L;
  const double room = 3.0 * L + 2.0 * R;
  scenario_.bounds = {{-room, -0.5 * room}, {room, 0.5 * room}};
  const double at = rng_.uniform(-0.2, 0.2) * room;
  box({-0.5 * thick, -0.5 * room}, {0.5 * thick, at - half});
  box({-0.5 * thick, at + half}, {0.5 * thick, 0.5 * room});
  const auto somewhere = [&](double side) {
    return centred({side * rng_.uniform(0.45, 0.7) * room, rng_.uniform(-0.15, 0.15) * room},
                   rng_.uniform(-0.8, 0.8) + (rng_.uniform() < 0.15 ? kPi : 0.0));
  };
  const Pose2 start = somewhere(-1.0);
  robot(start, somewhere(1.0));
}

void Maker::pocket() {
  const double side = 1.2 * (R + L) + W, lane = 0.5 * W * rng_.uniform(1.3, 1.8), length = 2.5 * L;
  scenario_.bounds = {{-length, -0.5 * side}, {side, 0.5 * side}};
  box({-length, -0.5 * side}, {0.0, -lane});
  box({-length, lane}, {0.0, 0.5 * side});
  const double x = -length + 0.5 * L + 2.0 * margin_ + rng_.uniform(0.0, 1.0) * L;
  robot(centred({x, 0.0}, 0.0), centred({x, 0.0}, kPi));
}

void Maker::lot() {
  const double bay = 1.4 * W, deep = 1.1 * L, aisle = 0.7 * R + L;
  const int bays = 6;
  const double end = 0.5 * bay * bays + L + R;
  scenario_.bounds = {{-end, -deep}, {end, aisle + deep}};
  const auto middle = [&](int row, int column) {
    return Vec2{bay * (column - 0.5 * (bays - 1)), row == 0 ? -0.5 * deep : aisle + 0.5 * deep};
  };
  const std::pair goal{rng_.below(2), rng_.below(bays)};
  std::pair from{rng_.below(2), rng_.below(bays)};
  const bool from_bay = from != goal && rng_.uniform() < 0.4;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < bays; ++column)
      if (const std::pair here{row, column};
          here != goal && !(from_bay && here == from) && rng_.uniform() < 0.7)
        parked(middle(row, column), true);
  const auto heading = [&] { return rng_.uniform() < 0.5 ? 0.5 * kPi : -0.5 * kPi; };
  const Pose2 start = from_bay ? centred(middle(from.first, from.second), heading())
                               : centred({0.5 * L - end + margin_ * 2.0, 0.5 * aisle}, 0.0);
  robot(start, centred(middle(goal.first, goal.second), heading()));
}

void Maker::rolling() {
  const double speed = rng_.uniform(0.2, 1.0) * model_.limits.speed;
  const double brake = speed * speed / (2.0 * model_.limits.acceleration);
  field(3.0 * brake + 8.0 * (L + R));
  const int variant = rng_.below(3);
  if (variant == 0) {  // near: before or just behind the place where it can stop
    robot({0.0, 0.0, 0.0},
          {rng_.uniform(0.3, 2.0) * brake, rng_.uniform(-0.3, 0.3) * L, rng_.uniform(-0.3, 0.3)}, speed);
  } else if (variant == 1) {
    robot({0.0, 0.0, 0.0},
          {-rng_.uniform(0.5, 4.0) * L, rng_.uniform(-2.0, 2.0) * L, rng_.uniform(-kPi, kPi)}, speed);
  } else {  // a wall, with room to stop; the goal beside it or back where the car came from
    const double wall = brake * rng_.uniform(1.05, 1.5) + (0.5 * L + ahead_) + 0.3 * L + margin_;
    box({wall, -2.0 * W}, {wall + W, 2.0 * W});
    robot({0.0, 0.0, 0.0}, {-rng_.uniform(0.5, 3.0) * L, 0.0, rng_.uniform(-0.2, 0.2)}, speed);
  }
}

void Maker::moving() {
  field(9.0 * L + 3.0 * R);
  const double radius = rng_.uniform(0.3, 0.8) * W;
  const double pace =
      rng_.uniform(0.2, 0.6) * std::min(model_.limits.speed, std::sqrt(model_.limits.acceleration * L));
  const double ready =
      3.0 * (std::sqrt(4.0 * L / model_.limits.acceleration) + 2.0 * L / model_.limits.speed);
  const auto obstacle = [&](std::vector<Waypoint> motion) {
    scenario_.obstacles.push_back(
        {.name = "mover", .shape = Circle{{}, radius}, .motion = std::move(motion)});
  };
  const auto from_to = [&](double t, Vec2 a, Vec2 b) {
    obstacle({{t, {a.x, a.y, 0.0}}, {t + geom::norm(b - a) / pace, {b.x, b.y, 0.0}}});
  };
  const double far = 7.0 * L;
  const int variant = rng_.below(5);
  const Pose2 start = centred({-far, 0.0}, 0.0), goal = centred({far, 0.0}, 0.0);
  if (variant == 0)
    from_to(0.0, {rng_.uniform(-3.0, 3.0) * L, -6.0 * L}, {rng_.uniform(-3.0, 3.0) * L, 6.0 * L});
  if (variant == 1) from_to(0.0, {4.0 * L, 0.0}, {-8.0 * L, rng_.uniform(1.5, 3.0) * (W + radius)});
  if (variant == 2) from_to(0.0, {-5.0 * L, 0.0}, {2.0 * L, 0.0});
  if (variant == 3) obstacle({{0.0, {rng_.uniform(-3.0, 3.0) * L, rng_.uniform(-0.3, 0.3) * W, 0.0}}});
  if (variant == 4) {
    const double begin = std::max(0.0, ready - 6.0 * L / pace);
    from_to(begin, {-6.0 * L - W, 0.0}, {6.0 * L + W, 0.0});
    robot(centred({0.0, 0.0}, 0.5 * kPi), centred({0.0, 0.0}, 0.5 * kPi));
    return;
  }
  robot(start, goal);
}

void Maker::swap_in_lane() {
  const double lane = 0.5 * W + margin_ + rng_.uniform(0.1, 0.3) * W;  // half of its width
  const double shift = W + 2.0 * margin_ + 0.3 * W;                    // from lane to bay
  const double bay = 0.5 * L + std::sqrt(std::max(4.0 * R * shift - shift * shift, 0.0)) + 0.5 * L;
  const double out = bay + 2.0 * L, end = out + 2.0 * L + R;
  const double top = lane + shift, half = std::max(top, 1.5 * (W + R));
  scenario_.bounds = {{-end, -half}, {end, half}};
  box({-out, -half}, {out, -lane});
  box({-out, lane}, {-bay, half});
  box({bay, lane}, {out, half});
  if (top < half) box({-bay, top}, {bay, half});
  robot(centred({-out - L, 0.0}, 0.0), centred({out + L, 0.0}, 0.0));
  robot(centred({out + L, 0.0}, kPi), centred({-out - L, 0.0}, kPi));
}

void Maker::swap_through_door() {
  const double half = 0.5 * W + margin_ + rng_.uniform(0.05, 0.3) * W, room = 3.0 * L + 2.0 * R;
  scenario_.bounds = {{-room, -0.6 * room}, {room, 0.6 * room}};
  box({-0.1 * L, -0.6 * room}, {0.1 * L, -half});
  box({-0.1 * L, half}, {0.1 * L, 0.6 * room});
  robot(centred({-0.6 * room, 0.0}, 0.0), centred({0.6 * room, 0.0}, 0.0));
  robot(centred({0.6 * room, 0.0}, kPi), centred({-0.6 * room, 0.0}, kPi));
}

void Maker::pair() {
  const int variant = rng_.below(4);
  if (variant == 0) return swap_in_lane();
  if (variant == 1) return swap_through_door();
  field(6.0 * L + 3.0 * R);
  if (variant == 2) {  // head-on
    robot(centred({-4.0 * L, 0.0}, 0.0), centred({4.0 * L, 0.0}, 0.0));
    robot(centred({4.0 * L, rng_.uniform(-0.5, 0.5) * W}, kPi), centred({-4.0 * L, 0.0}, kPi));
    return;
  }
  // A queue: the one behind goes as far as the one before it stood, or past it.
  const double gap = L + 2.0 * margin_ + rng_.uniform(0.0, 0.5) * L;
  const bool past = rng_.uniform() < 0.5;
  robot(centred({0.0, 0.0}, 0.0), centred({past ? gap : 4.0 * L, 0.0}, 0.0));
  robot(centred({-gap, 0.0}, 0.0), centred({past ? 4.0 * L : 4.0 * L - gap, 0.0}, 0.0));
}

Scenario Maker::make() {
  switch (kind_) {
    case Everyday::open:
      open();
      break;
    case Everyday::near:
      near();
      break;
    case Everyday::forward_only:
      forward_only();
      break;
    case Everyday::slalom:
      slalom();
      break;
    case Everyday::parallel:
      parallel();
      break;
    case Everyday::garage:
      garage();
      break;
    case Everyday::door:
      door();
      break;
    case Everyday::pocket:
      pocket();
      break;
    case Everyday::lot:
      lot();
      break;
    case Everyday::rolling:
      rolling();
      break;
    case Everyday::moving:
      moving();
      break;
    case Everyday::pair:
      pair();
      break;
  }
  scenario_.models = {model_};
  return std::move(scenario_);
}

}  // namespace

const char* name_of(Everyday kind) {
  return kNames[static_cast<std::size_t>(kind)].name;
}

std::optional<Everyday> everyday_named(std::string_view name) {
  for (const Named& named : kNames)
    if (named.name == name) return named.kind;
  return std::nullopt;
}

std::span<const Everyday> all_everyday() {
  static const auto kinds = [] {
    std::array<Everyday, kNames.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = kNames[i].kind;
    return all;
  }();
  return kinds;
}

Scenario everyday(Everyday kind, const vehicle::Model& vehicle, std::uint64_t seed) {
  return Maker(kind, vehicle, seed).make();
}

}  // namespace seine::world
