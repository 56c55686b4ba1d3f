#include "seine/sim/scene.hpp"

#include <algorithm>

#include "seine/net/flight.hpp"
#include "seine/net/hanging.hpp"
#include "seine/sim/cord_net.hpp"

namespace seine::sim {
namespace {

using geom::Vec2;
using geom::Vec3;

constexpr double kSettling = 2.0;  // s for a payload to hang still before the scene begins …
constexpr int kMoreSettlings = 3;  // … and as often again as it then still swings faster than this
constexpr double kStill = 0.05;    // m/s

std::string sentence(const char* what, std::size_t index, std::size_t count, Fate fate) {
  const std::string who = count > 1 ? std::string(what) + " " + std::to_string(index + 1) : std::string(what);
  switch (fate) {
    case Fate::inside:
      return who + " has fallen through the rim";
    case Fate::caught:
      return who + " lies in the net";
    case Fate::restless:
      return who + " does not come to rest in the net";
    case Fate::miss:
      return who + " missed the net";
    case Fate::side:
      return who + " left the net under its rim";
    case Fate::out:
      return who + " bounced out of the net";
    case Fate::bottom:
      return who + " touched the ground in the net";
    case Fate::leak:
      return who + " went through the net";
    case Fate::flying:
      break;
  }
  return who + " flies";
}

Outcome outcome_of(const CatchWatch* watch, bool arrived) {
  if (watch == nullptr) return {};
  return {.fate = watch->fate(),
          .delivered = arrived && watch->fate() == Fate::caught && watch->at_rest(),
          .crossing_time = watch->crossing_time(),
          .catch_time = watch->catch_time(),
          .lowest = watch->lowest()};
}

}  // namespace

Scene::Scene(const world::Scenario& scenario, std::span<const Vec3> corners, const Noise& noise, Rng& seeds)
    : physics_(
          std::make_unique<CordNet>(*scenario.net, corners, material_of_rebound(scenario.net->rebound))) {
  for (const net::Target& target : scenario.targets) {
    thrown_.emplace_back(target, scenario.net->rim(), noise, seeds.next());
    // Asked for at every tick: a flight with much drag takes long to integrate.
    const auto crossing = net::Flight(thrown_.back().truth()).crossing(scenario.net->rim());
    if (crossing) last_crossing_ = std::max(last_crossing_, crossing->state.time);
  }
  if (scenario.payload && thrown_.empty()) put_payload(scenario, corners);
  known_.assign(thrown_.size(), Fate::flying);
}

void Scene::put_payload(const world::Scenario& scenario, std::span<const Vec3> corners) {
  const net::Net& net = *scenario.net;
  std::vector<Vec2> ground;
  for (const Vec3 corner : corners) ground.push_back(corner.ground());
  const std::vector<net::Hanging> places = net::equilibria(net.rest, ground, net.rim());
  const net::Payload& payload = *scenario.payload;
  Vec3 place = places.empty() ? physics_->nodes()[net.size()] : places.front().position;
  // Above the cloth, which hangs less deep while it is empty.
  const auto& mesh = physics_->mesh();
  for (std::size_t v = 0; v < mesh.flat.size(); ++v) {
    const Vec3 node = physics_->nodes()[v];
    if (geom::norm((node - place).ground()) < payload.radius + 2.0 * mesh.face_reach)
      place.z = std::max(place.z, node.z);
  }
  place.z += 2.0 * payload.radius;
  const std::size_t ball = physics_->add({.position = place, .radius = payload.radius, .mass = payload.mass});
  physics_->advance(corners, kSettling);
  for (int i = 0; i < kMoreSettlings && norm(physics_->ball(ball).velocity) > kStill; ++i)
    physics_->advance(corners, kSettling);
  payload_.emplace(ball, net.rim(), Fate::caught);
}

void Scene::look(double time, const std::vector<Faults::TargetJump>& jumps) {
  for (std::size_t i = 0; i < thrown_.size(); ++i) {
    Vec3 shift;
    for (const Faults::TargetJump& jump : jumps)
      if (jump.target == i && time >= jump.from && time < jump.from + jump.duration) shift += jump.shift;
    thrown_[i].look(time, *physics_, shift);
  }
}

void Scene::advance(double time, double duration, std::span<const Vec3> corners) {
  physics_->advance(corners, duration);
  for (Thrown& thrown : thrown_) thrown.watch(time, *physics_, corners);
  if (payload_) payload_->look(time, *physics_, corners);
}

std::vector<net::Target> Scene::in_the_air() const {
  std::vector<net::Target> targets;
  for (const Thrown& thrown : thrown_)
    if (thrown.in_the_air()) targets.push_back(thrown.estimate());
  return targets;
}

std::vector<Outcome> Scene::outcomes(bool arrived) const {
  std::vector<Outcome> outcomes;
  for (const Thrown& thrown : thrown_) outcomes.push_back(outcome_of(thrown.verdict(), arrived));
  if (payload_) outcomes.push_back(outcome_of(&*payload_, arrived));
  return outcomes;
}

std::vector<std::string> Scene::news() {
  std::vector<std::string> news;
  for (std::size_t i = 0; i < thrown_.size(); ++i) {
    if (thrown_[i].fate() == known_[i]) continue;
    known_[i] = thrown_[i].fate();
    news.push_back(sentence("the target", i, thrown_.size(), known_[i]));
  }
  return news;
}

void Scene::record(Record& record) {
  for (Thrown& thrown : thrown_) record.targets.push_back(thrown.record(*physics_));
  if (payload_) {
    TargetRecord payload;
    payload.ball = physics_->ball(0);
    payload.fate = payload_->fate();
    payload.present = true;
    payload.touching = physics_->touching(0);
    record.targets.push_back(payload);
  }
  record.mesh = &physics_->mesh();
  record.nodes.assign(physics_->nodes().begin(), physics_->nodes().end());
}

}  // namespace seine::sim
