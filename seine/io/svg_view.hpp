#pragma once

#include <string>

#include "seine/geom/box.hpp"
#include "seine/io/svg.hpp"

namespace seine::io {

/// Where the world stands on the page: x right, y down, px.
struct SvgView {
  geom::Box world;     ///< the part that is drawn, m
  double scale = 1.0;  ///< px per m
  geom::Vec2 corner;   ///< px, of the drawn area's upper left

  geom::Vec2 operator()(geom::Vec2 p) const {
    return {corner.x + scale * (p.x - world.low.x), corner.y + scale * (world.high.y - p.y)};
  }
  geom::Vec2 size() const { return scale * world.size(); }  ///< px
};

/// The bounds, or where the team uses less than half of them, the part it uses with some room around it.
SvgView choose_view(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                    const SvgOptions& options, geom::Vec2 corner);

/// A px coordinate or length with two decimals.
std::string px(double value);
std::string px(geom::Vec2 point);
/// `text` fit for an element's content or an attribute.
std::string xml_text(const std::string& text);

/// The round number (1, 2 or 5 times a power of ten) nearest below `value`.
double round_below(double value);

}  // namespace seine::io
