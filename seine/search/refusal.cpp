#include "seine/search/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/search/leaving.hpp"
#include "seine/search/motion.hpp"

namespace seine::search {
namespace {

using Cause = Refusal::Cause;

constexpr double kGranted = 1e-3;    // m of width: more than the certificate grants on both sides together
constexpr double kCell = 0.12;       // car widths, side of a cell of the proof
constexpr double kSmallSide = 0.25;  // of the world: less ground than this is closed in

template <class... Numbers>
std::string text(const char* pattern, Numbers... numbers) {
  char buffer[400];
  std::snprintf(buffer, sizeof buffer, pattern, numbers...);
  return buffer;
}

Cause cause_of(const Bottleneck& place, const geom::Box& bounds) {
  const geom::Vec2 size = bounds.size();
  if (place.smaller_side > kSmallSide * size.x * size.y) return Cause::too_narrow;
  return place.nearer_to_goal ? Cause::goal_closed_in : Cause::start_closed_in;
}

// ", by the wall and the bounds"
std::string by(const Refusal& refusal) {
  return refusal.beside.empty() ? "" : ", by " + refusal.beside;
}

const char* why(Cause cause) {
  if (cause == Cause::goal_closed_in) return "its goal is closed in";
  return cause == Cause::start_closed_in ? "its start is closed in" : "the way is closed";
}

std::string advice(const Refusal& refusal, double margin) {
  const double spare = 0.5 * (refusal.place->width - refusal.width);
  if (spare <= 0.0) return "the opening is narrower than the car";
  return text("a margin to obstacles of %.3g m instead of %.3g m would let it through", 0.999 * spare,
              margin);
}

// What stands nearest to the place, and what is hardly further away on another side.
std::string what_is_beside(const world::StaticMap& map, const Bottleneck& place) {
  constexpr double kWider = 1.3;
  const double cap = 0.5 * kWider * place.width + kGranted;
  std::vector<std::pair<double, std::string>> found;  // every obstacle once
  map.for_each_near(geom::Box{place.at, place.at}.inflated(cap), [&](const world::StaticMap::Piece& piece) {
    const double distance = geom::separation({{place.at}, 0.0}, piece.shape).distance;
    if (distance > cap) return;
    std::string name =
        piece.obstacle < 0 ? "the map" : map.describe(static_cast<int>(&piece - map.pieces().data()));
    const auto known = std::ranges::find(found, name, &std::pair<double, std::string>::second);
    if (known == found.end())
      found.emplace_back(distance, std::move(name));
    else
      known->first = std::min(known->first, distance);
  });
  const geom::Box& b = map.bounds();
  const double edge = std::min(std::min(place.at.x - b.low.x, place.at.y - b.low.y),
                               std::min(b.high.x - place.at.x, b.high.y - place.at.y));
  if (edge <= cap) found.emplace_back(edge, "the bounds");
  std::ranges::stable_sort(found, {}, &std::pair<double, std::string>::first);
  if (found.empty()) return "";
  return found.size() == 1 ? found[0].second : found[0].second + " and " + found[1].second;
}

}  // namespace

Refusal why_no_way(const world::Scenario& scenario, const world::StaticMap& map, int robot) {
  const world::Robot& car = scenario.robots[static_cast<std::size_t>(robot)];
  const vehicle::Model& model = scenario.model_of(car);
  const DiscCover cover(model.footprint);
  const geom::Vec2 middle{cover.widest().x, cover.axis};
  Refusal refusal;
  refusal.width = 2.0 * cover.widest().inner;
  // Inside the margin a car may have less on its way out.
  const double margin =
      starts_inside_margin(scenario, map, car) ? *scenario.margins.leaving : scenario.margins.obstacle;
  refusal.needed = refusal.width + 2.0 * margin;
  refusal.place =
      bottleneck(map, car.start * middle, *car.goal * middle, kCell * model.width(),
                 refusal.needed - kGranted, std::max(0.5 * model.length() + margin, refusal.needed));
  if (refusal.place && refusal.place->upper_width < refusal.needed - kGranted)
    refusal.cause = cause_of(*refusal.place, map.bounds());
  if (refusal.place) refusal.beside = what_is_beside(map, *refusal.place);
  return refusal;
}

std::string sentence(const Refusal& refusal, const world::Scenario& scenario, int robot) {
  const world::Robot& car = scenario.robots[static_cast<std::size_t>(robot)];
  const double margin = 0.5 * (refusal.needed - refusal.width);
  if (refusal.cause == Cause::no_time) return car.name + ": the deadline came before a path was found";
  const geom::Vec2 at = refusal.place ? scenario.origin + refusal.place->at : geom::Vec2{};
  if (refusal.cause != Cause::no_room_found) {
    const std::string closed =
        car.name + " cannot reach its goal (proved unreachable): " + why(refusal.cause);
    if (refusal.place->width < kGranted)
      return closed +
             text(", without any opening; what closes it is thinnest near (%.2f, %.2f)", at.x, at.y) +
             by(refusal);
    return closed +
           text(
               ", the widest way is only %.3g m wide at (%.2f, %.2f) and %.3g m is needed (%.3g m for the "
               "car, "
               "%.3g m of margin on each side)",
               refusal.place->width, at.x, at.y, refusal.needed, refusal.width, margin) +
           by(refusal) + "; " + advice(refusal, margin);
  }
  const double radius = 1.0 / scenario.model_of(car).max_curvature();
  std::string found = car.name + ": no path found";
  if (!refusal.place)
    return found +
           text(
               ", though the ground is wide; its turning circle (radius %.3g m%s) may have no room at the "
               "start or the goal",
               radius, scenario.model_of(car).limits.reverse_speed > 0.0 ? "" : ", no reverse gear");
  const char* gear = scenario.model_of(car).limits.reverse_speed > 0.0 ? "" : " without a reverse gear";
  const std::string turn = text(": no room found to turn with a radius of %.3g m%s; ", radius, gear);
  const char* hint =
      scenario.model_of(car).limits.reverse_speed > 0.0
          ? ". A smaller margin or turning circle, or another heading at the goal, may help"
          : ". A reverse gear ('reverse_speed' is 0), a smaller margin or turning circle, or another heading "
            "at the goal, may help";
  if (refusal.place->width >= refusal.needed) {
    return found + turn +
           text(
               "straight on there is room everywhere (%.3g m wide at the narrowest place, (%.2f, %.2f), and "
               "%.3g m is needed)",
               refusal.place->width, at.x, at.y, refusal.needed) +
           hint;
  }
  return found + turn +
         text(
             "the widest way is %.3g m wide at its narrowest place, (%.2f, %.2f), and %.3g m is needed to go "
             "straight through",
             refusal.place->width, at.x, at.y, refusal.needed) +
         by(refusal) + hint;
}

std::string cannot_pass_sentence(const world::Scenario& scenario, int a, int b) {
  const world::Robot &first = scenario.robots[static_cast<std::size_t>(a)],
                     &second = scenario.robots[static_cast<std::size_t>(b)];
  return first.name + " and " + second.name +
         " cannot both reach their goals (proved): on their ways there is no place where one could pass the "
         "other or "
         "make way for it; a wider place, a bay, other goals "
         "or smaller margins would help";
}

std::string narrowest_for_net(const world::Scenario& scenario, const world::StaticMap& map) {
  if (!scenario.net || scenario.robots.empty()) return "";
  for (const world::Obstacle& obstacle : scenario.obstacles)
    if (std::isfinite(obstacle.height)) return "";  // the net may pass over it
  geom::Vec2 from, goals;
  bool all_have = true;
  const double share = 1.0 / static_cast<double>(scenario.robots.size());
  double body = 0.0;
  for (const world::Robot& robot : scenario.robots) {
    from += share * robot.start.position();
    if (robot.goal)
      goals += share * robot.goal->position();
    else
      all_have = false;
    body = std::max(body, scenario.model_of(robot).width());
  }
  if (!scenario.delivery && !all_have) return "";
  const geom::Vec2 to = scenario.delivery ? scenario.delivery->center : goals;
  double span = 0.0;  // m, of the net at rest
  for (const geom::Vec2 a : scenario.net->rest)
    for (const geom::Vec2 b : scenario.net->rest) span = std::max(span, geom::norm(a - b));
  const auto place =
      bottleneck(map, from, to, kCell * body, 0.0, 0.5 * (span + body) + scenario.margins.obstacle);
  if (!place) return "";
  const geom::Vec2 at = scenario.origin + place->at;
  return text("; the widest way is %.3g m wide at its narrowest place, (%.2f, %.2f)", place->width, at.x,
              at.y);
}

Verdict why_no_ways(const world::Scenario& scenario, const world::StaticMap& map, std::span<const int> robots,
                    bool late) {
  constexpr std::size_t kInFull = 3;
  Verdict verdict;
  for (const int robot : robots.first(std::min(kInFull, robots.size()))) {
    Refusal refusal;
    if (late)
      refusal.cause = Cause::no_time;
    else
      refusal = why_no_way(scenario, map, robot);
    verdict.proved = verdict.proved || refusal.proved();
    verdict.reason += (verdict.reason.empty() ? "" : "; ") + sentence(refusal, scenario, robot);
  }
  if (robots.size() > kInFull)
    verdict.reason += "; and " + std::to_string(robots.size() - kInFull) + " more cars";
  return verdict;
}

}  // namespace seine::search
