#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace seine::tests {

/// A room and the rooms it may use, as tools/floorplan.txt says.
struct FloorPlan {
  std::vector<std::string> rooms;                     ///< in the order of the file
  std::map<std::string, std::set<std::string>> uses;  ///< by room
};

/// Reads the plan of the tree at `root`; what is wrong with the plan itself goes to `offences`.
FloorPlan read_floor_plan(const std::filesystem::path& root, std::vector<std::string>& offences);

/// Everything in the tree at `root` that breaks the floor plan, as "file:line: what". Empty when the house
/// stands:
/// - every folder under seine/ is a room of the plan, with files and at most a folder `test` in it, or a
/// wing: a folder of such rooms, which the plan names "wing/room";
/// - a room includes itself and the rooms on its line, by full path, and only files that exist;
/// - what a room is the only one to know (YAML, JSON, PNG: io; the command line: apps) appears nowhere else;
/// - the roof (apps, bench, examples, fuzz, tests, …) includes rooms and its own folder, and no room includes
/// the roof.
std::vector<std::string> offences(const std::filesystem::path& root);

}  // namespace seine::tests
