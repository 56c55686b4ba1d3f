#include "seine/certify/net_proof.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/height.hpp"
#include "seine/certify/ring.hpp"
#include "seine/certify/tolerances.hpp"
#include "seine/certify/underneath.hpp"

namespace seine::certify {
namespace {

void append(std::vector<Finding>& to, std::vector<Finding> from) {
  for (Finding& finding : from) to.push_back(std::move(finding));
}

}  // namespace

std::string why_no_net(const world::Scenario& scenario) {
  if (!scenario.net) {
    return scenario.targets.empty() && !scenario.payload && !scenario.delivery
               ? ""
               : "there is something to catch or to carry, and no net";
  }
  const std::size_t corners = scenario.net->size(), held = scenario.net->attachments.size();
  if (corners >= 3 && corners == held && held == scenario.robots.size()) return {};
  return format(
      "the net has %zu corners and %zu attachments for %zu robots; three or more of each are needed", corners,
      held, scenario.robots.size());
}

NetVerdict prove_net(Context& context, const Scene& scene, const traj::TeamTrajectory& plan,
                     const std::vector<std::optional<net::Crossing>>& crossings) {
  NetVerdict verdict;
  const net::Net& net = *context.scenario.net;
  const Formation formation(net, scene.robots, scene.horizon, phases_of(context.scenario, crossings));
  if (!formation.complete()) {
    verdict.findings.push_back(
        {{Kind::undecided, 0.0, -1, -1, 0.0, 0.0, "the plan has too many pieces to prove its net"}, 0.0});
    return verdict;
  }
  RingProof ring(context, formation);
  ring.run();
  append(verdict.findings, ring.findings());

  Height height(net);
  DragProof drag(context, formation, height);
  drag.run();
  append(verdict.findings, drag.findings());

  const double lowest = net.clearance + drag.closest().clearance - kHeightResolution;
  UnderneathProof underneath(context, formation, height, lowest);
  underneath.run(scene);
  append(verdict.findings, underneath.take_findings());

  append(verdict.findings, check_payload(context));
  CatchCheck catches(context, plan, scene);
  verdict.catches = catches.run(crossings);
  append(verdict.findings, catches.take_findings());
  append(verdict.findings, check_delivery(context, plan));
  verdict.room = {ring.stretch(), ring.convexity(), drag.closest(), underneath.closest(), ring.holding()};
  return verdict;
}

}  // namespace seine::certify
