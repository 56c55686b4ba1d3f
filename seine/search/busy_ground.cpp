#include "seine/search/busy_ground.hpp"

#include <algorithm>
#include <limits>

namespace seine::search {

void unite(std::vector<Span>& spans) {
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
  std::size_t kept = 0;
  for (const Span& span : spans) {
    if (kept > 0 && span.begin <= spans[kept - 1].end)
      spans[kept - 1].end = std::max(spans[kept - 1].end, span.end);
    else
      spans[kept++] = span;
  }
  spans.resize(kept);
}

BusyGround::BusyGround(std::span<const Traffic> traffic, const SweptFootprint& footprint, double tick)
    : traffic_(traffic), footprint_(footprint), tick_(tick), polygon_(footprint.corners()) {}

std::span<const Span> BusyGround::busy(const geom::Pose2& pose, const Slack& slack) {
  const OrientedBox turned = footprint_.cover(pose, slack, polygon_);
  const geom::Box box = geom::bounding_box(polygon_);
  spans_.clear();
  for (const Traffic& other : traffic_)
    if (other.body->box().overlaps(box.inflated(other.clearance))) add(other, box, turned);
  unite(spans_);
  return spans_;
}

void BusyGround::add(const Traffic& other, const geom::Box& box, const OrientedBox& turned) {
  const MovingBody& body = *other.body;
  const geom::Box near = box.inflated(other.clearance);
  for (const MovingBody::Chunk& chunk : body.chunks()) {
    if (!chunk.box.overlaps(near)) continue;
    for (int e = chunk.first; e < chunk.last; ++e) {
      const MovingBody::Event& event = body.events()[static_cast<std::size_t>(e)];
      if (!event.box.overlaps(near)) continue;
      if (apart(turned, polygon_, footprint_.is_box(), body, e, other.clearance)) continue;
      const double end = event.end == MovingBody::kForever ? std::numeric_limits<double>::infinity()
                                                           : (event.end - 0.5) * tick_;
      const double begin = std::max(0.0, (event.begin - 0.5) * tick_);
      if (!spans_.empty() && spans_.back().begin <= begin && begin <= spans_.back().end)
        spans_.back().end = std::max(spans_.back().end, end);
      else
        spans_.push_back({begin, end});
    }
  }
}

}  // namespace seine::search
