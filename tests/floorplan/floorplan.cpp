#include "tests/floorplan/floorplan.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

namespace seine::tests {
namespace {

namespace fs = std::filesystem;
using Offences = std::vector<std::string>;

constexpr std::array<std::string_view, 7> kRoof{"apps", "bench", "bindings", "examples",
                                                "fuzz", "tests", "viewer"};
constexpr std::array<std::string_view, 5> kNamedForNothing{"utils", "util", "misc", "helpers", "common"};

/// A library, and the only folder that may know it.
struct Secret {
  std::string_view header;
  std::string_view owner;
};
constexpr std::array<Secret, 4> kSecrets{
    {{"yaml-cpp/", "io"}, {"nlohmann/", "io"}, {"png.h", "io"}, {"CLI/", "apps"}}};

struct Include {
  int line;
  bool quoted;
  std::string path;
};

bool is_code(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".hpp" || extension == ".cpp" || extension == ".h" || extension == ".cc";
}

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> found;
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", at);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of("\">", open + 1);
    found.push_back({number, line[open] == '"', line.substr(open + 1, close - open - 1)});
  }
  return found;
}

/// The first folder of a path: "seine" of "seine/geom/vec2.hpp".
std::string head(const std::string& path) {
  return path.substr(0, path.find('/'));
}

/// The room a file under seine/ is in: "geom", or "baseline/letter" where that is a room of the plan.
std::string room_of_include(const std::string& path, const FloorPlan& plan) {
  const std::size_t slash = path.find('/');
  if (slash == std::string::npos) return {};
  const std::string inside = path.substr(slash + 1), first = head(inside);
  const std::string nested = inside.substr(0, inside.find('/', std::min(first.size() + 1, inside.size())));
  return plan.uses.contains(nested) ? nested : first;
}

/// Whether a folder under seine/ is no room but a wing: a folder of rooms.
bool is_wing(const std::string& folder, const FloorPlan& plan) {
  return !plan.uses.contains(folder) &&
         std::any_of(plan.rooms.begin(), plan.rooms.end(),
                     [&](const auto& room) { return room.starts_with(folder + "/"); });
}

/// Collects complaints about one folder: a room, or a part of the roof.
class Inspector {
 public:
  Inspector(const fs::path& root, const FloorPlan& plan, Offences& offences)
      : root_(root), plan_(plan), offences_(offences) {}

  void inspect(const fs::path& folder, const std::string& name, bool roof) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || !is_code(entry.path())) continue;
      for (const Include& include : includes_of(entry.path())) {
        const std::string complaint = judge(include, name, roof);
        if (!complaint.empty()) complain(entry.path(), include.line, complaint);
      }
    }
  }

  void complain(const fs::path& where, int line, const std::string& what) {
    offences_.push_back(fs::relative(where, root_).generic_string() + ":" + std::to_string(line) + ": " +
                        what);
  }

 private:
  std::string judge(const Include& include, const std::string& name, bool roof) const {
    for (const Secret& secret : kSecrets) {
      if (include.path.starts_with(secret.header) && name != secret.owner && !(roof && name != "examples")) {
        return "<" + include.path + "> is the business of " + std::string(secret.owner) + " only";
      }
    }
    const std::string top = head(include.path);
    const bool of_roof = std::find(kRoof.begin(), kRoof.end(), top) != kRoof.end();
    if (!include.quoted) {
      return top == "seine" || of_roof ? "the project's own headers are included in quotes" : std::string();
    }
    if (include.path.find("./") != std::string::npos || include.path.find('/') == std::string::npos) {
      return "\"" + include.path + "\" is relative: write the path from the top of the tree";
    }
    if (of_roof)
      return roof && top == name ? exists(include) : "\"" + include.path + "\" is roof: nothing includes it";
    if (top != "seine") return "\"" + include.path + "\" is no part of the house";
    const std::string used = room_of_include(include.path, plan_);
    if (!plan_.uses.contains(used)) return "\"" + include.path + "\": there is no room " + used;
    if (!roof && used != name && !plan_.uses.at(name).contains(used)) {
      return "room " + name + " may not include room " + used;
    }
    if (name != "tests" && (roof || used != name) && include.path.find("/test/") != std::string::npos) {
      return "\"" + include.path + "\" belongs to the tests of room " + used;
    }
    return exists(include);
  }

  std::string exists(const Include& include) const {
    return fs::exists(root_ / include.path) ? std::string() : "\"" + include.path + "\" does not exist";
  }

  const fs::path& root_;
  const FloorPlan& plan_;
  Offences& offences_;
};

/// Folders and files where no folder or file should be.
void inspect_layout(const fs::path& room, const std::string& name, const FloorPlan& plan,
                    Inspector& inspector) {
  if (!plan.uses.contains(name)) {
    inspector.complain(room, 0, "the folder is not on the floor plan");
    return;
  }
  for (const auto& entry : fs::directory_iterator(room)) {
    if (entry.is_directory() && entry.path().filename() != "test") {
      inspector.complain(entry.path(), 0, "a room has no folders but test");
    }
  }
}

/// A folder under seine/: a room, or with `wing` "baseline/" one of its rooms.
void inspect_folder(const fs::path& folder, const std::string& wing, const FloorPlan& plan,
                    Inspector& inspector) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = wing + entry.path().filename().string();
    if (!entry.is_directory()) {
      inspector.complain(entry.path(), 0, "a file outside every room");
    } else if (is_wing(name, plan)) {
      inspect_folder(entry.path(), name + "/", plan, inspector);
    } else {
      inspect_layout(entry.path(), name, plan, inspector);
      if (plan.uses.contains(name)) inspector.inspect(entry.path(), name, false);
    }
  }
}

}  // namespace

FloorPlan read_floor_plan(const fs::path& root, Offences& offences) {
  FloorPlan plan;
  std::ifstream in(root / "tools" / "floorplan.txt");
  if (!in) offences.push_back("tools/floorplan.txt:0: missing");
  int number = 0;
  const auto complain = [&](const std::string& what) {
    offences.push_back("tools/floorplan.txt:" + std::to_string(number) + ": " + what);
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) {
      complain("expected 'room: rooms it may use'");
      continue;
    }
    const std::string room = line.substr(0, colon);
    if (plan.uses.contains(room)) complain("room " + room + " stands twice");
    if (std::find(kNamedForNothing.begin(), kNamedForNothing.end(), room) != kNamedForNothing.end()) {
      complain("room " + room + " is named for nothing");
    }
    std::set<std::string> uses;
    std::istringstream words(line.substr(colon + 1));
    for (std::string used; words >> used;) {
      if (!plan.uses.contains(used))
        complain("room " + room + " uses " + used + ", which is on no earlier line");
      uses.insert(used);
    }
    plan.rooms.push_back(room);
    plan.uses[room] = uses;
  }
  return plan;
}

std::vector<std::string> offences(const fs::path& root) {
  Offences found;
  const FloorPlan plan = read_floor_plan(root, found);
  Inspector inspector(root, plan, found);
  if (fs::exists(root / "seine")) inspect_folder(root / "seine", "", plan, inspector);
  for (const std::string_view roof : kRoof) {
    if (fs::exists(root / roof)) inspector.inspect(root / roof, std::string(roof), true);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace seine::tests
