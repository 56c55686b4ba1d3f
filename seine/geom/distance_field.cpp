#include "seine/geom/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace seine::geom {
namespace {

// Squares of this many cells still fit the 16-bit integers of the transform.
constexpr int kMaxCells = 180;
// A node-to-piece distance costs about half of what the transform costs a node, so up to four a node are worth being exact.
constexpr double kExactPerNode = 4.0;
constexpr double kBandPerNode = 1.5;
// Taken off before a distance becomes a float, so that rounding never raises it.
constexpr double kRounding = 1e-6;  // m

// The signed distance of points to one convex piece, with what can be computed once per piece.
class PointDistance {
 public:
  explicit PointDistance(const Convex& piece) : core_(piece.core), radius_(piece.radius) {
    for (std::size_t i = 0; core_.size() > 1 && i < core_.size(); ++i) {
      const Vec2 along = core_[i + 1 == core_.size() ? 0 : i + 1] - core_[i];
      const double length = norm(along);
      faces_.push_back({core_[i], along / length, length});
    }
  }

  double operator()(Vec2 p) const {
    double widest = -std::numeric_limits<double>::infinity();
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Face& face : faces_) {
      const Vec2 from = p - face.tail;
      const double gap = -cross(face.along, from);
      widest = std::max(widest, gap);
      if (gap < 0.0) continue;
      const double past = dot(face.along, from);
      const double aside = past < 0.0 ? past : std::max(past - face.length, 0.0);
      nearest2 = std::min(nearest2, gap * gap + aside * aside);
    }
    if (faces_.empty()) nearest2 = squared_norm(p - core_.front());
    return (widest < 0.0 && !faces_.empty() ? widest : std::sqrt(nearest2)) - radius_;
  }

 private:
  struct Face {
    Vec2 tail, along;
    double length;
  };
  std::span<const Vec2> core_;
  double radius_;
  std::vector<Face> faces_;
};

struct Window {
  int column_low, column_high, row_low, row_high;
};

Window nodes_within(const DistanceField& field, const Box& box) {
  const auto index = [&field](double offset, int count, bool up) {
    const double i = offset / field.cell;
    return static_cast<int>(std::clamp(up ? std::ceil(i) : std::floor(i), -1.0, static_cast<double>(count)));
  };
  return {std::max(index(box.low.x - field.origin.x, field.width, true), 0),
          std::min(index(box.high.x - field.origin.x, field.width, false), field.width - 1),
          std::max(index(box.low.y - field.origin.y, field.height, true), 0),
          std::min(index(box.high.y - field.origin.y, field.height, false), field.height - 1)};
}

// Nodes to visit for all pieces when each is treated out to `band` metres.
double work(std::span<const Convex* const> pieces, std::span<const Box> boxes, double band, double cell) {
  double nodes = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec2 size = boxes[i].inflated(band).size();
    nodes += (size.x / cell + 1.0) * (size.y / cell + 1.0);
  }
  return nodes;
}

double choose_band(std::span<const Convex* const> pieces, std::span<const Box> boxes, const DistanceField& field) {
  const double nodes = static_cast<double>(field.values.size());
  if (work(pieces, boxes, field.cap, field.cell) <= kExactPerNode * nodes) return field.cap;
  double band = field.cap;
  while (band > field.cell && work(pieces, boxes, band, field.cell) > kBandPerNode * nodes) band *= 0.7;
  return std::min(field.cap, std::max(band, field.cell));
}

void write_band(const Convex& piece, const Box& box, double band, DistanceField& field) {
  const Window window = nodes_within(field, box.inflated(band));
  const PointDistance distance_to(piece);
  for (int row = window.row_low; row <= window.row_high; ++row) {
    const double y = field.origin.y + row * field.cell;
    const double dy = std::max({box.low.y - y, y - box.high.y, 0.0});
    // Only the part of the row within `band` of the box.
    const double reach = std::sqrt(std::max(band * band - dy * dy, 0.0));
    const Window part = nodes_within(field, {{box.low.x - reach, y}, {box.high.x + reach, y}});
    float* out = field.values.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(field.width);
    for (int column = part.column_low; column <= part.column_high; ++column) {
      const double d = distance_to({field.origin.x + column * field.cell, y});
      if (d < band) out[column] = std::min(out[column], static_cast<float>(d - kRounding));
    }
  }
}

// Squared distance in cells, at most limit², of each node to the nearest one whose value is below `seed`; first along the columns,
// then along the rows [Saito94]. Loops run along rows so that they vectorise.
std::vector<std::int16_t> transform(const DistanceField& field, float seed, int limit) {
  const std::size_t width = static_cast<std::size_t>(field.width);
  const std::size_t height = static_cast<std::size_t>(field.height);
  const std::int16_t far = static_cast<std::int16_t>(limit);
  std::vector<std::int16_t> up(width * height);
  for (std::size_t i = 0; i < up.size(); ++i) up[i] = field.values[i] < seed ? std::int16_t{0} : far;
  const auto carry = [&up, width](std::size_t from, std::size_t to) {
    for (std::size_t i = 0; i < width; ++i) {
      up[to + i] = std::min(up[to + i], static_cast<std::int16_t>(up[from + i] + 1));
    }
  };
  for (std::size_t row = 1; row < height; ++row) carry((row - 1) * width, row * width);
  for (std::size_t row = height - 1; row-- > 0;) carry((row + 1) * width, row * width);
  for (std::int16_t& value : up) value = static_cast<std::int16_t>(value * value);

  std::vector<std::int16_t> result = up;
  for (std::size_t row = 0; row < height; ++row) {
    const std::int16_t* in = up.data() + row * width;
    std::int16_t* out = result.data() + row * width;
    const std::size_t last = std::min(static_cast<std::size_t>(limit), width);
    for (std::size_t shift = 1; shift < last; ++shift) {
      // Saturates instead of overflowing: sums are below 2·180², which 16 bits unsigned hold.
      const std::uint16_t cost = static_cast<std::uint16_t>(shift * shift);
      const std::uint16_t ceiling = static_cast<std::uint16_t>(limit * limit);
      const auto offer = [cost, ceiling](std::int16_t value) {
        const std::uint16_t sum = static_cast<std::uint16_t>(static_cast<std::uint16_t>(value) + cost);
        return static_cast<std::int16_t>(std::min(sum, ceiling));
      };
      for (std::size_t i = 0; i + shift < width; ++i) out[i] = std::min(out[i], offer(in[i + shift]));
      for (std::size_t i = shift; i < width; ++i) out[i] = std::min(out[i], offer(in[i - shift]));
    }
  }
  return result;
}

// What the band has not reached: every obstacle point is within half a diagonal of a seed node.
void fill_far(double band, DistanceField& field) {
  const double half_diagonal = field.cell * std::sqrt(0.5);
  const int limit = std::min(kMaxCells, static_cast<int>(std::ceil((field.cap + half_diagonal) / field.cell)));
  const std::vector<std::int16_t> squared = transform(field, static_cast<float>(half_diagonal), limit);
  std::vector<float> distance(static_cast<std::size_t>(limit * limit) + 1);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double d = field.cell * std::sqrt(static_cast<double>(i)) - half_diagonal;
    distance[i] = static_cast<float>(std::clamp(d, band, field.cap) - kRounding);
  }
  const float untouched = static_cast<float>(field.cap);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (field.values[i] >= untouched) field.values[i] = distance[static_cast<std::size_t>(squared[i])];
  }
}

}  // namespace

DistanceField distance_field(std::span<const Convex* const> pieces, const Box& extent, double cell, double cap) {
  DistanceField field;
  field.origin = extent.low;
  field.cell = cell;
  field.cap = std::min(cap, (kMaxCells - 1) * cell);
  field.width = static_cast<int>(std::ceil(extent.size().x / cell - 1e-9)) + 1;
  field.height = static_cast<int>(std::ceil(extent.size().y / cell - 1e-9)) + 1;
  const std::size_t nodes = static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height);
  field.values.assign(nodes, static_cast<float>(field.cap));
  if (pieces.empty()) return field;

  std::vector<Box> boxes;
  boxes.reserve(pieces.size());
  for (const Convex* piece : pieces) boxes.push_back(piece->box());
  const double band = choose_band(pieces, boxes, field);
  for (std::size_t i = 0; i < pieces.size(); ++i) write_band(*pieces[i], boxes[i], band, field);
  if (band < field.cap) fill_far(band, field);
  return field;
}

DistanceField distance_field(std::span<const Convex> pieces, const Box& extent, double cell, double cap) {
  std::vector<const Convex*> pointers;
  pointers.reserve(pieces.size());
  for (const Convex& piece : pieces) pointers.push_back(&piece);
  return distance_field(std::span<const Convex* const>(pointers), extent, cell, cap);
}

DistanceField::Place DistanceField::locate(Vec2 p) const {
  const double u = (p.x - origin.x) / cell;
  const double v = (p.y - origin.y) / cell;
  const double cu = std::clamp(u, 0.0, static_cast<double>(width - 1));
  const double cv = std::clamp(v, 0.0, static_cast<double>(height - 1));
  const int column = std::max(std::min(static_cast<int>(cu), width - 2), 0);
  const int row = std::max(std::min(static_cast<int>(cv), height - 2), 0);
  const bool inside = u == cu && v == cv;
  return {static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column), cu - column,
          cv - row, inside ? 0.0 : cell * norm({u - cu, v - cv})};
}

double DistanceField::interpolate(const Place& at) const {
  const float* low = values.data() + at.node;
  const float* high = low + (height > 1 ? width : 0);
  const int next = width > 1 ? 1 : 0;
  const double below = low[0] + at.s * static_cast<double>(low[next] - low[0]);
  const double above = high[0] + at.s * static_cast<double>(high[next] - high[0]);
  return below + at.t * (above - below);
}

double DistanceField::value(Vec2 p) const { return interpolate(locate(p)); }

double DistanceField::lower_bound(Vec2 p) const {
  const Place at = locate(p);
  return interpolate(at) - cell * std::sqrt(at.s * (1.0 - at.s) + at.t * (1.0 - at.t)) - at.beyond;
}

}  // namespace seine::geom
