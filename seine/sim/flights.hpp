#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "seine/geom/vec3.hpp"
#include "seine/net/flight.hpp"
#include "seine/sim/flight_filter.hpp"

// What was measured elsewhere, for tests and benchmarks: `data` is the folder of that name.
namespace seine::sim {

struct Sight {
  double time = 0.0;  // s
  geom::Vec3 position;
};
using Track = std::vector<Sight>;

inline std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(file, line);  // names of the columns
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

inline Track read_track(const std::filesystem::path& path, double seconds_per_unit) {
  Track track;
  for (const auto& row : read_csv(path)) {
    track.push_back(
        {seconds_per_unit * std::stod(row[0]), {std::stod(row[1]), std::stod(row[2]), std::stod(row[3])}});
  }
  return track;
}

/// Thrown balls seen by motion capture at 300 Hz, 0.4 s or longer.
inline std::vector<Track> thrown_balls(const std::filesystem::path& data) {
  const std::filesystem::path folder = data / "trajectories" / "jugglebot_throws";
  std::vector<Track> tracks;
  for (const auto& row : read_csv(folder / "index.csv")) {
    if (std::stod(row[5]) < 0.4 || !std::filesystem::exists(folder / row[0])) continue;
    tracks.push_back(read_track(folder / row[0], 1.0));
  }
  return tracks;
}

/// Table-tennis balls up to their first bounce, 100 samples a second. `year` is how the file's name begins.
/// Tracks with gaps (steps beyond 0.1 m) are left out, or are the only ones taken.
inline std::vector<Track> table_tennis(const std::filesystem::path& data, const std::string& year,
                                       bool with_gaps = false) {
  const std::filesystem::path folder = data / "trajectories" / "mpi_tabletennis";
  std::vector<Track> tracks;
  for (const auto& row : read_csv(folder / "index.csv")) {
    const auto bounce = static_cast<std::size_t>(std::max(0, std::stoi(row[3])));
    const bool gap = std::stod(row[2]) > 0.1;
    if (row[0].rfind(year, 0) != 0 || bounce < 20 || gap != with_gaps) continue;
    if (!std::filesystem::exists(folder / row[0])) continue;
    Track track = read_track(folder / row[0], 0.01);
    track.resize(bounce);
    tracks.push_back(std::move(track));
  }
  return tracks;
}

/// Where a straight line through the first `count` sights in x and y, and a fall at g in z, lead to at
/// `time`.
inline geom::Vec3 line_fit(const Track& track, std::size_t count, double time) {
  const auto fit = [&](auto value) {
    double n = 0.0, t = 0.0, y = 0.0, tt = 0.0, ty = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double at = track[i].time, v = value(track[i]);
      n += 1.0, t += at, y += v, tt += at * at, ty += at * v;
    }
    const double slope = (n * ty - t * y) / (n * tt - t * t);
    return (y - slope * t) / n + slope * time;
  };
  const auto fallen = [](double at) { return 0.5 * net::kGravity * at * at; };
  return {fit([](const Sight& s) { return s.position.x; }), fit([](const Sight& s) { return s.position.y; }),
          fit([&](const Sight& s) { return s.position.z + fallen(s.time); }) - fallen(time)};
}

/// How much of a flight is seen before its end is foretold.
inline constexpr std::array kParts{0.3, 0.5, 0.7};

/// Medians over many flights of the error at the last sample, mm, for each of kParts.
struct Errors {
  std::array<double, 3> filter{}, line{};
};

inline Errors errors_of(const std::vector<Track>& tracks, double noise) {
  const auto median = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  Errors errors;
  for (std::size_t p = 0; p < kParts.size(); ++p) {
    std::vector<double> filter, line;
    for (const Track& track : tracks) {
      const auto count = static_cast<std::size_t>(kParts[p] * static_cast<double>(track.size()));
      FlightFilter seen({.noise = noise});
      for (std::size_t i = 0; i < count; ++i) seen.observe(track[i].time, track[i].position);
      const Sight& last = track.back();
      filter.push_back(1e3 * norm(seen.position_at(last.time) - last.position));
      line.push_back(1e3 * norm(line_fit(track, count, last.time) - last.position));
    }
    errors.filter[p] = median(filter);
    errors.line[p] = median(line);
  }
  return errors;
}

}  // namespace seine::sim
