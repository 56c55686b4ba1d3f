#include "seine/search/busy_ground.hpp"

#include <algorithm>
#include <limits>

#include "seine/geom/convex.hpp"

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

BusyGround::BusyGround(std::span<const Traffic> traffic, const SweptFootprint& footprint, double tick,
                       double grain)
    : footprint_(footprint), polygon_(footprint.corners()) {
  for (const Traffic& other : traffic) add(other, tick, grain);
}

void BusyGround::add(const Traffic& other, double tick, double grain) {
  constexpr std::size_t kChunk = 8;
  const std::span<const MovingBody::Event> events = other.body->events();
  std::size_t first_of_chunk = pieces_.size();
  std::vector<geom::Vec2> points;
  for (std::size_t e = 0; e < events.size();) {
    const geom::Vec2 size = events[e].box.size() + geom::Vec2{grain, grain};
    geom::Box box = events[e].box;
    points.clear();
    const int begin = events[e].begin;
    int end = events[e].end;
    for (std::size_t from = e; e < events.size(); ++e) {
      geom::Box joined = box;
      joined.include(events[e].box.low), joined.include(events[e].box.high);
      // What stands is apart, or it would stand longer than it does.
      if (e > from &&
          (joined.size().x > size.x || joined.size().y > size.y || events[e].end == MovingBody::kForever))
        break;
      box = joined;
      end = std::max(end, events[e].end);
      const auto polygon = other.body->polygon(static_cast<int>(e));
      points.insert(points.end(), polygon.begin(), polygon.end());
    }
    const std::vector<geom::Vec2> hull = geom::convex_hull(points);
    const double until =
        end == MovingBody::kForever ? std::numeric_limits<double>::infinity() : (end - 0.5) * tick;
    pieces_.push_back({box.inflated(other.clearance),
                       {std::max(0.0, (begin - 0.5) * tick), until},
                       corners_.size(),
                       corners_.size() + hull.size(),
                       other.clearance});
    corners_.insert(corners_.end(), hull.begin(), hull.end());
    if (pieces_.size() - first_of_chunk == kChunk)
      close_chunk(first_of_chunk), first_of_chunk = pieces_.size();
  }
  if (first_of_chunk < pieces_.size()) close_chunk(first_of_chunk);
}

void BusyGround::close_chunk(std::size_t first) {
  Chunk chunk{pieces_[first].box, first, pieces_.size()};
  for (std::size_t i = first; i < pieces_.size(); ++i)
    chunk.box.include(pieces_[i].box.low), chunk.box.include(pieces_[i].box.high);
  chunks_.push_back(chunk);
}

std::span<const Span> BusyGround::busy(const geom::Pose2& pose, const Slack& slack) {
  footprint_.cover(pose, slack, polygon_);
  const geom::Box box = geom::bounding_box(polygon_);
  spans_.clear();
  for (const Chunk& chunk : chunks_) {
    if (!chunk.box.overlaps(box)) continue;
    for (std::size_t i = chunk.first; i < chunk.last; ++i) {
      const Piece& piece = pieces_[i];
      if (!piece.box.overlaps(box)) continue;
      const std::span hull(&corners_[piece.begin], piece.end - piece.begin);
      if (apart(polygon_, hull, piece.clearance)) continue;
      if (!spans_.empty() && spans_.back().begin <= piece.span.begin && piece.span.begin <= spans_.back().end)
        spans_.back().end = std::max(spans_.back().end, piece.span.end);
      else
        spans_.push_back(piece.span);
    }
  }
  unite(spans_);
  return spans_;
}

}  // namespace seine::search
