#pragma once

#include <vector>

#include "seine/certify/report.hpp"
#include "seine/certify/stretch.hpp"
#include "seine/certify/tolerances.hpp"

namespace seine::certify {

/// One car at one side of a joint.
struct Side {
  Frame frame;
  double speed = 0.0;      ///< v, m/s, signed: negative backwards
  double curvature = 0.0;  ///< 1/m, of the front wheel
};

/// Where one stretch ends and the next begins, position, heading, speed and curvature must not jump. What is
/// granted to rounding is granted once for the whole plan: all jumps of a car are added up.
class Joints {
 public:
  Joints(const Context& context, int robot);

  /// In motion. @param where for people, as in "between curve pieces"
  void join(const Side& a, const Side& b, double time, const char* where);
  /// Between two segments. @param stops whether the car has to be at rest there; @param wait s, for which it
  /// is
  void join_segments(const Side& a, const Side& b, double time, bool stops, double wait);
  std::vector<Finding> findings() const;

 private:
  struct Sum {
    double granted = 0.0;
    const char* what = "";
    const char* unit = "";
    double total = 0.0, largest = 0.0, time = 0.0;
    const char* where = "";
    void add(double jump, double at, const char* place);
  };
  void join_places(const Side& a, const Side& b, double time, const char* where);

  const Context& context_;
  int robot_;
  double wheelbase_, steering_rate_;
  Granted granted_;
  Sum position_, heading_, speed_, curvature_;
  std::vector<Finding> rests_;
};

}  // namespace seine::certify
