#include "seine/geom/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace seine::geom {
namespace {

// The sum of two squares of this many cells still fits the 16-bit integers of the transform.
constexpr int kMaxCells = 127;
// A node-to-piece distance costs about half of what the transform costs a node, so up to four a node are
// worth being exact.
constexpr double kExactPerNode = 4.0;
constexpr double kBandPerNode = 1.5;
// Taken off per metre of the coordinates involved, so that rounding to single precision never raises a
// distance.
constexpr double kRounding = 1e-6;

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

double choose_band(std::span<const Convex* const> pieces, std::span<const Box> boxes,
                   const DistanceField& field) {
  const double nodes = static_cast<double>(field.values.size());
  if (work(pieces, boxes, field.cap, field.cell) <= kExactPerNode * nodes) return field.cap;
  double band = field.cap;
  while (band > field.cell && work(pieces, boxes, band, field.cell) > kBandPerNode * nodes) band *= 0.7;
  return std::min(field.cap, std::max(band, field.cell));
}

// Writes the signed distance to one piece after another into the nodes that are nearer than `band` to it.
// Rows are done a face at a time in single precision, relative to the piece, so that the loops vectorise.
class BandWriter {
 public:
  BandWriter(DistanceField& field, double band) : field_(field), band_(band) {
    const std::size_t width = static_cast<std::size_t>(field.width);
    widest_.resize(width);
    nearest_.resize(width);
    ramp_.resize(width);
    for (std::size_t i = 0; i < width; ++i)
      ramp_[i] = static_cast<float>(static_cast<double>(i) * field.cell);
  }

  void write(const Convex& piece, const Box& box) {
    faces_.clear();
    const std::vector<Vec2>& core = piece.core;
    for (std::size_t i = 0; i < core.size(); ++i) {
      const Vec2 along = core[i + 1 == core.size() ? 0 : i + 1] - core[i];
      const double length = norm(along);
      faces_.push_back({core[i], length > 0.0 ? along / length : Vec2{1.0, 0.0}, length});
    }
    inside_possible_ = core.size() > 2;
    radius_ = static_cast<float>(piece.radius);
    const Vec2 size = box.size();
    lowered_ = static_cast<float>(kRounding * (1.0 + size.x + size.y + band_));
    const Window window = nodes_within(field_, box.inflated(band_));
    for (int row = window.row_low; row <= window.row_high; ++row) {
      write_row(window.column_low, window.column_high, row);
    }
  }

 private:
  struct Face {
    Vec2 tail, along;
    double length;
  };

  void write_row(int column_low, int column_high, int row) {
    if (column_high < column_low) return;
    const std::size_t count = static_cast<std::size_t>(column_high - column_low + 1);
    std::fill_n(widest_.begin(), count, -kFar);
    std::fill_n(nearest_.begin(), count, kFar);
    const Vec2 first{field_.origin.x + column_low * field_.cell, field_.origin.y + row * field_.cell};
    for (const Face& face : faces_) add_face(face, first - face.tail, count);
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.width);
    float* out = field_.values.data() + start + static_cast<std::size_t>(column_low);
    const float* widest = widest_.data();
    const float* nearest = nearest_.data();
    const float limit = static_cast<float>(band_);
    for (std::size_t i = 0; i < count; ++i) {
      const float outside = std::sqrt(nearest[i]);
      const float core = inside_possible_ && widest[i] < 0.0f ? widest[i] : outside;
      const float d = core - radius_ - lowered_;
      out[i] = d < out[i] && d < limit ? d : out[i];
    }
  }

  // `from`: the row's first node seen from the face's tail.
  void add_face(const Face& face, Vec2 from, std::size_t count) {
    const float gap_start = static_cast<float>(-cross(face.along, from));
    const float gap_step = static_cast<float>(face.along.y);
    const float past_start = static_cast<float>(dot(face.along, from));
    const float past_step = static_cast<float>(face.along.x);
    const float length = static_cast<float>(face.length);
    const float hidden = inside_possible_
                             ? 0.0f
                             : -kFar;  // a face that looks away is not the nearest, unless it is all there is
    float* widest = widest_.data();
    float* nearest = nearest_.data();
    const float* ramp = ramp_.data();
    for (std::size_t i = 0; i < count; ++i) {
      const float gap = gap_start + gap_step * ramp[i];
      const float past = past_start + past_step * ramp[i];
      const float low = past > 0.0f ? past : 0.0f;
      const float aside = past - (low < length ? low : length);
      const float squared = gap * gap + aside * aside;
      const float seen = gap < hidden ? kFar : squared;
      widest[i] = gap > widest[i] ? gap : widest[i];
      nearest[i] = seen < nearest[i] ? seen : nearest[i];
    }
  }

  static constexpr float kFar = 1e30f;
  DistanceField& field_;
  double band_;
  std::vector<Face> faces_;
  bool inside_possible_ = false;
  float radius_ = 0.0f;
  float lowered_ = 0.0f;
  std::vector<float> widest_, nearest_, ramp_;
};

// Squared distance in cells, at most limit², of each node to the nearest one whose value is below `seed`;
// first along the columns, then along the rows [Saito94]. Loops run along rows so that they vectorise.
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

  // A border of far nodes to either side saves the loop its ends.
  const std::size_t border = static_cast<std::size_t>(limit);
  std::vector<std::int16_t> line(width + 2 * border, static_cast<std::int16_t>(limit * limit));
  for (std::size_t row = 0; row < height; ++row) {
    std::int16_t* out = up.data() + row * width;
    std::copy_n(out, width, line.data() + border);
    for (std::size_t shift = 1; shift < border; ++shift) {
      const std::int16_t cost = static_cast<std::int16_t>(shift * shift);
      const std::int16_t* left = line.data() + border - shift;
      const std::int16_t* right = line.data() + border + shift;
      for (std::size_t i = 0; i < width; ++i) {
        const std::int16_t nearer = static_cast<std::int16_t>(std::min(left[i], right[i]) + cost);
        out[i] = std::min(out[i], nearer);
      }
    }
  }
  return up;
}

// What the band has not reached: every obstacle point is within half a diagonal of a seed node.
void fill_far(double band, DistanceField& field) {
  const double half_diagonal = field.cell * std::sqrt(0.5);
  const int limit =
      std::min(kMaxCells, static_cast<int>(std::ceil((field.cap + half_diagonal) / field.cell)));
  const std::vector<std::int16_t> squared = transform(field, static_cast<float>(half_diagonal), limit);
  std::vector<float> distance(static_cast<std::size_t>(limit * limit) + 1);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double d = field.cell * std::sqrt(static_cast<double>(i)) - half_diagonal;
    distance[i] = static_cast<float>(std::clamp(d, band, field.cap) - kRounding * (1.0 + field.cap));
  }
  const float untouched = static_cast<float>(field.cap);
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    if (field.values[i] >= untouched) field.values[i] = distance[static_cast<std::size_t>(squared[i])];
  }
}

}  // namespace

DistanceField distance_field(std::span<const Convex* const> pieces, const Box& extent, double cell,
                             double cap) {
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
  BandWriter writer(field, band);
  for (std::size_t i = 0; i < pieces.size(); ++i) writer.write(*pieces[i], boxes[i]);
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
  return {static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column),
          cu - column, cv - row, inside ? 0.0 : cell * norm(Vec2{u - cu, v - cv})};
}

double DistanceField::interpolate(const Place& at) const {
  const float* low = values.data() + at.node;
  const float* high = low + (height > 1 ? width : 0);
  const int next = width > 1 ? 1 : 0;
  const double below = low[0] + at.s * static_cast<double>(low[next] - low[0]);
  const double above = high[0] + at.s * static_cast<double>(high[next] - high[0]);
  return below + at.t * (above - below);
}

double DistanceField::value(Vec2 p) const {
  return interpolate(locate(p));
}

double DistanceField::lower_bound(Vec2 p) const {
  const Place at = locate(p);
  return interpolate(at) - cell * std::sqrt(at.s * (1.0 - at.s) + at.t * (1.0 - at.t)) - at.beyond;
}

}  // namespace seine::geom
