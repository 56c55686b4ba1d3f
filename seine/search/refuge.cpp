#include "seine/search/refuge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "seine/geom/convex.hpp"
#include "seine/search/open_entry.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kLaneStep = 0.2;    // of the other's length, between its footprints
constexpr double kLaneSlack = 0.01;  // of its length
constexpr double kApart = 1.0;       // car lengths between refuges
constexpr double kReverse = 1.3;     // what a metre backwards costs
constexpr double kGearChange = 1.0;  // turning radii

struct Node {
  geom::Pose2 pose;
  Arc arc;  // that led here
  double cost, room;
  int parent;  // −1 at the root
};

class Search {
 public:
  Search(const FootprintChecker& checker, const Lane& lane, const RefugeSettings& settings)
      : checker_(checker),
        lane_(lane),
        s_(settings),
        moves_(Primitives::fan(settings.radius, settings.step, 5, settings.reverse ? 5 : 0)),
        body_(checker.model().footprint.size()) {}

  std::vector<Route> run(const geom::Pose2& start, std::size_t most);

 private:
  std::uint64_t bin(const geom::Pose2& pose, int gear) const;
  bool is_refuge(const geom::Pose2& pose);
  void expand(int index);
  Route route_to(int index) const;

  const FootprintChecker& checker_;
  const Lane& lane_;
  const RefugeSettings& s_;
  Primitives moves_;
  std::vector<Node> nodes_;
  std::vector<OpenEntry> open_;
  std::unordered_map<std::uint64_t, char> closed_;
  std::vector<geom::Vec2> body_;
};

std::uint64_t Search::bin(const geom::Pose2& pose, int gear) const {
  const geom::Pose2& origin = nodes_.front().pose;
  const auto index = [&](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / s_.cell + 0.5)) +
                                      (1 << 20));
  };
  const double angle = 2.0 * std::numbers::pi / s_.headings;
  const auto heading = static_cast<std::int64_t>(std::floor(pose.heading / angle + 0.5));
  const auto turn = static_cast<std::uint64_t>((heading % s_.headings + s_.headings) % s_.headings);
  return index(pose.x - origin.x) << 43 | index(pose.y - origin.y) << 21 | turn << 1 |
         static_cast<std::uint64_t>(gear < 0);
}

bool Search::is_refuge(const geom::Pose2& pose) {
  geom::place(checker_.model().footprint, pose, body_);
  return lane_.room(body_, s_.room) >= s_.room;
}

void Search::expand(int index) {
  const Node from = nodes_[static_cast<std::size_t>(index)];
  for (const Arc& move : moves_.arcs) {
    const geom::Pose2 pose = vehicle::drive(from.pose, move);
    if (closed_.contains(bin(pose, move.gear()))) continue;
    const double room = checker_.sweep(from.pose, from.room, move, pose);
    if (room < 0.0) continue;
    double cost = from.cost + std::abs(move.distance) * (move.gear() < 0 ? kReverse : 1.0);
    if (from.parent >= 0 && from.arc.gear() != move.gear()) cost += kGearChange * s_.radius;
    nodes_.push_back({pose, move, cost, room, index});
    open_.push_back({cost, static_cast<int>(nodes_.size()) - 1});
    std::push_heap(open_.begin(), open_.end());
  }
}

Route Search::route_to(int index) const {
  const auto at = [&](int i) -> const Node& { return nodes_[static_cast<std::size_t>(i)]; };
  Route route{nodes_.front().pose, at(index).pose, {}};
  for (int i = index; at(i).parent >= 0; i = at(i).parent) route.arcs.push_back(at(i).arc);
  std::reverse(route.arcs.begin(), route.arcs.end());
  merge(route.arcs);
  return route;
}

std::vector<Route> Search::run(const geom::Pose2& start, std::size_t most) {
  std::vector<Route> found;
  const double apart = kApart * checker_.model().length();
  nodes_.push_back({start, {}, 0.0, checker_.room(start), -1});
  if (nodes_.front().room < 0.0) return found;
  open_.push_back({0.0, 0});
  int expansions = 0;
  while (!open_.empty() && found.size() < most && expansions < s_.max_expansions) {
    const int index = open_.front().node;
    std::pop_heap(open_.begin(), open_.end());
    open_.pop_back();
    const Node here = nodes_[static_cast<std::size_t>(index)];
    if (!closed_.emplace(bin(here.pose, here.arc.gear()), 1).second) continue;
    const bool known = std::ranges::any_of(found, [&](const Route& other) {
      return geom::norm(other.goal.position() - here.pose.position()) < apart;
    });
    if (!known && is_refuge(here.pose)) found.push_back(route_to(index));
    if (++expansions % 64 == 0 && s_.deadline.expired()) break;
    expand(index);
  }
  return found;
}

}  // namespace

void Lane::add(const vehicle::Model& model, const Path& way, double clearance) {
  const double step = kLaneStep * model.length(), length = way.length();
  const double with_slack = clearance + kLaneSlack * model.length();
  for (double s = 0.0;; s += step) {
    std::vector<geom::Vec2> footprint(model.footprint.size());
    geom::place(model.footprint, pose_at(way, std::min(s, length)), footprint);
    const geom::Box box = geom::bounding_box(footprint).inflated(with_slack);
    places_.push_back({std::move(footprint), box, with_slack});
    if (s >= length) break;
  }
}

double Lane::room(std::span<const geom::Vec2> body, double cap) const {
  const geom::Box box = geom::bounding_box(body).inflated(cap);
  double least = cap;
  for (const Place& place : places_) {
    if (!place.box.overlaps(box)) continue;
    least = std::min(least, geom::distance(body, place.footprint) - place.clearance);
    if (least < 0.0) break;
  }
  return least;
}

std::vector<Route> refuges(const geom::Pose2& start, const FootprintChecker& checker, const Lane& lane,
                           const RefugeSettings& settings, std::size_t most) {
  return Search(checker, lane, settings).run(start, most);
}

}  // namespace seine::search
