#pragma once

#include <filesystem>
#include <string>

namespace seine::tests {

/// What one run of the program left behind.
struct Outcome {
  int status = -1;  ///< exit status; −1 when it was killed by a signal
  std::string out;
  std::string err;
  double seconds = 0.0;
};

/// A scratch folder, gone with the object, and the program run in it.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// Runs `seine ARGUMENTS` (shell syntax) in the folder.
  Outcome run(const std::string& arguments) const;
  /// The same with redirections of its own, after `before` (as "ulimit -f 4;").
  Outcome run_in_shell(const std::string& arguments, const std::string& before = "") const;
  /// Writes a file into the folder.
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  Outcome call(const std::string& command) const;

  std::filesystem::path folder_;
};

/// Exactly one line, ended.
bool is_one_line(const std::string& text);

/// A busy machine is several times slower, sanitizers more: times are held against limits with this factor.
double patience();

/// A small valid task: two cars that pass each other, and whatever else `extra` adds (YAML at the top level).
std::string two_cars(const std::string& extra = "");
/// Almost the same task: a plan for two_cars() is none for it.
std::string two_cars_elsewhere();

}  // namespace seine::tests
