#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/mpc/tracker.hpp"

namespace seine::mpc {

/// A reference as a function of time.
using Course = std::function<Sample(double t)>;

inline vehicle::Model small_car() {
  vehicle::Model model;
  model.footprint = vehicle::rectangle_footprint(0.6, 0.4, 0.1);
  model.wheelbase = 0.4;
  model.limits = {.speed = 2.5, .reverse_speed = 2.5, .acceleration = 3.0, .steering = 0.7};
  return model;
}

inline Course straight(double speed) {
  return [speed](double t) { return Sample{{speed * t, 0.0, 0.0, speed}, {}}; };
}

/// Round a circle at constant speed (negative: backwards), exactly drivable.
inline Course circle(double speed, double steering, double wheelbase) {
  return [=](double t) {
    return Sample{advance({0.0, 0.0, 0.3, speed}, {0.0, steering}, wheelbase, t), {0.0, steering}};
  };
}

inline Course course_of(const traj::RobotTrajectory& trajectory, double wheelbase) {
  return [&trajectory, wheelbase](double t) {
    Sample s;
    sample(trajectory, wheelbase, t, 1.0, {&s, 1});
    return s;
  };
}

/// What happened at one command.
struct Moment {
  double t;
  State state;  ///< true state when the command was given
  Sample wanted;
  Command command;

  double distance() const { return std::hypot(state.x - wanted.state.x, state.y - wanted.state.y); }
  double heading() const { return std::abs(geom::wrap_angle(state.heading - wanted.state.heading)); }
};

/// Something done to the car, or to what the tracker is told, in every period.
using Disturbance = std::function<void(double t, State& state)>;

struct Run {
  State start;
  double duration = 5.0;
  Disturbance pushed = {};   ///< moves the car
  Disturbance misread = {};  ///< changes what is measured
};

/// The bicycle itself, integrated exactly, under the tracker's commands.
inline std::vector<Moment> drive(Tracker& tracker, const vehicle::Model& model, const Course& course,
                                 const Run& run) {
  const Options& options = tracker.options();
  std::vector<Sample> reference(static_cast<std::size_t>(options.horizon) + 1);
  std::vector<Input> underway(static_cast<std::size_t>(std::ceil(options.dead_time / options.period - 1e-9)));
  std::vector<Moment> moments;
  State state = run.start;
  const int steps = static_cast<int>(std::lround(run.duration / options.period));
  for (int i = 0; i < steps; ++i) {
    const double t = i * options.period;
    for (std::size_t k = 0; k < reference.size(); ++k)
      reference[k] = course(t + options.dead_time + options.step * static_cast<double>(k));
    State measured = state;
    if (run.misread) run.misread(t, measured);
    const Command command = tracker.step(measured, reference);
    moments.push_back({t, state, course(t), command});
    underway.push_back(command.input);
    state = advance(state, underway.front(), model.wheelbase, options.period);
    underway.erase(underway.begin());
    if (run.pushed) run.pushed(t, state);
  }
  return moments;
}

inline double worst_after(const std::vector<Moment>& moments, double t, double (Moment::*what)() const) {
  double worst = 0.0;
  for (const Moment& m : moments)
    if (m.t >= t) worst = std::max(worst, (m.*what)());
  return worst;
}

inline double rms_distance(const std::vector<Moment>& moments) {
  double sum = 0.0;
  for (const Moment& m : moments) sum += m.distance() * m.distance();
  return std::sqrt(sum / static_cast<double>(moments.size()));
}

}  // namespace seine::mpc
