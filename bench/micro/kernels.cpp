// The optimiser's inner loops: the time of one item is one sample with its gradient, or one close pair-sample
// with its gradient.
#include <benchmark/benchmark.h>

#include <vector>

#include "seine/base/rng.hpp"
#include "seine/constraint/inter_vehicle.hpp"
#include "seine/trajopt/kernels.hpp"
#include "seine/trajopt/proximity.hpp"
#include "seine/vehicle/model.hpp"

namespace {

using namespace seine;

constexpr int kPieces = 8;

// A gently bent curve at nominal length 1 a piece, coefficient-major.
struct Curve {
  std::vector<double> cx, cy, gcx, gcy;
  Curve() : cx(6 * kPieces), cy(6 * kPieces), gcx(6 * kPieces), gcy(6 * kPieces) {
    Rng rng(1);
    for (int j = 0; j < kPieces; ++j) {
      cx[static_cast<std::size_t>(j)] = j;
      cx[static_cast<std::size_t>(kPieces + j)] = 1.0;
      for (int k = 2; k < 6; ++k) cy[static_cast<std::size_t>(k * kPieces + j)] = 0.2 * rng.normal();
    }
  }
};

void curve_sample(benchmark::State& state) {
  Curve curve;
  const trajopt::CurveWeights weights{0.3, 1.0, 0.03, 1.0, 0.1};
  trajopt::CurveLanes lanes;
  double g_length = 0.0;
  for (auto _ : state)
    for (std::size_t j = 0; j < kPieces; ++j) {
      benchmark::DoNotOptimize(
          trajopt::curve_piece(&curve.cx[j], &curve.cy[j], kPieces, weights, lanes, g_length));
      trajopt::curve_piece_adjoint(lanes, &curve.gcx[j], &curve.gcy[j], kPieces);
    }
  state.counters["per_sample"] =
      benchmark::Counter(static_cast<double>(kPieces * trajopt::kCurveLanes),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(curve_sample)->Repetitions(5)->ReportAggregatesOnly();

// `begin`: where on a piece of the curve a piece of progress begins; beyond 0 it lies astride two.
void time_sample(benchmark::State& state, double begin) {
  Curve curve;
  std::vector<double> cu(6 * kPieces), gcu(6 * kPieces);
  for (int j = 0; j < kPieces; ++j) {
    cu[static_cast<std::size_t>(j)] = j + begin;
    cu[static_cast<std::size_t>(kPieces + j)] = 0.9;
    cu[static_cast<std::size_t>(2 * kPieces + j)] = 0.1;
  }
  const trajopt::CurveView view{curve.cx.data(),  curve.cy.data(), curve.gcx.data(),
                                curve.gcy.data(), kPieces,         kPieces};
  const trajopt::TimeWeights weights{1.0, 0.8,  0.1, 0.1,
                                     0.0, 0.03, 1.0};  // limits low enough that every term is active
  double g_duration = 0.0;
  for (auto _ : state)
    for (std::size_t j = 0; j < kPieces; ++j)
      benchmark::DoNotOptimize(trajopt::time_piece(&cu[j], &gcu[j], kPieces, view, weights, g_duration));
  state.counters["per_sample"] =
      benchmark::Counter(static_cast<double>(kPieces * trajopt::kTimeLanes),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(time_sample, on_one_piece, 0.0)->Repetitions(5)->ReportAggregatesOnly();
BENCHMARK_CAPTURE(time_sample, astride_two, 0.4)->Repetitions(5)->ReportAggregatesOnly();

// Cars that pass each other, tick by tick, as the optimiser meets them.
constexpr std::size_t kEncounters = 16, kTicks = 16, kPairs = kEncounters * kTicks;
std::vector<constraint::OrientedBox> encounters() {
  Rng rng(2);
  std::vector<constraint::OrientedBox> boxes;
  for (std::size_t encounter = 0; encounter < kEncounters; ++encounter) {
    const double heading = rng.uniform(-3.0, 3.0), beside = rng.uniform(-1.2, 1.2);
    for (std::size_t tick = 0; tick < kTicks; ++tick) {
      const double along = 0.0667 * (static_cast<double>(tick) - 0.5 * kTicks);
      const geom::Vec2 d = geom::unit(heading);
      boxes.push_back({{along, 0.0}, {1.0, 0.0}, 0.33, 0.5, 0.33});
      boxes.push_back({geom::Vec2{0.0, beside} + along * d, d, 0.33, 0.5, 0.33});
    }
  }
  return boxes;
}

benchmark::Counter per_pair() {
  return {static_cast<double>(kPairs),
          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

// Distance and gradient, side by side; boxes are laid into the lanes within the time measured.
void pair_sample(benchmark::State& state) {
  const std::vector<constraint::OrientedBox> boxes = encounters();
  constraint::PairLanes lanes;
  constexpr std::size_t kLanes = constraint::PairLanes::kLanes;
  for (auto _ : state)
    for (std::size_t begin = 0; begin < kPairs; begin += kLanes) {
      for (std::size_t j = 0; j < kLanes; ++j)
        constraint::put(boxes[2 * (begin + j)], boxes[2 * (begin + j) + 1], lanes, j);
      constraint::inter_vehicle(lanes, kLanes);
      benchmark::DoNotOptimize(lanes);
    }
  state.counters["per_pair"] = per_pair();
}
BENCHMARK(pair_sample)->Repetitions(5)->ReportAggregatesOnly();

// The same one by one, by the plain function.
void pair_sample_plain(benchmark::State& state) {
  const std::vector<constraint::OrientedBox> boxes = encounters();
  constraint::PairGradient gradient;
  for (auto _ : state)
    for (std::size_t i = 0; i < kPairs; ++i) {
      benchmark::DoNotOptimize(constraint::inter_vehicle(boxes[2 * i], boxes[2 * i + 1], gradient));
      benchmark::DoNotOptimize(gradient);
    }
  state.counters["per_pair"] = per_pair();
}
BENCHMARK(pair_sample_plain)->Repetitions(5)->ReportAggregatesOnly();

// The whole term of the joint problem: states are looked up, penalties and gradients added up. The clearance
// is so large that every sample counts.
void pair_term(benchmark::State& state) {
  const std::vector<constraint::OrientedBox> boxes = encounters();
  const trajopt::Shape shape = trajopt::shape_of(vehicle::rectangle_footprint(1.0, 0.66, 0.17), 1.0);
  std::vector<trajopt::ClockState> states(2 * kPairs);
  for (std::size_t i = 0; i < kPairs; ++i)
    for (std::size_t car = 0; car < 2; ++car) {
      states[car * kPairs + i].position = boxes[2 * i + car].position;
      states[car * kPairs + i].direction = boxes[2 * i + car].direction;
    }
  trajopt::Proximity proximity({shape, shape}, {}, {}, 3.0, static_cast<int>(kPairs));
  proximity.rebuild(states, 0.0, 0.0);
  for (auto _ : state)
    for (int chunk = 0; chunk < proximity.chunks(); ++chunk)
      benchmark::DoNotOptimize(proximity.evaluate(chunk, states, 1e-9, 0.03));
  state.counters["per_pair"] = per_pair();
}
BENCHMARK(pair_term)->Repetitions(5)->ReportAggregatesOnly();

}  // namespace
