#include "tests/cli/program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace seine::tests {

namespace fs = std::filesystem;

Scratch::Scratch() {
  std::string name = (fs::temp_directory_path() / "seine-cli-XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Outcome Scratch::run(const std::string& arguments) const {
  return call("'" SEINE_PROGRAM "' " + arguments);
}

Outcome Scratch::run_in_shell(const std::string& arguments, const std::string& before) const {
  return call("{ " + before + " '" SEINE_PROGRAM "' " + arguments + "; }");
}

// The redirections come first: those of the command itself overrule them.
Outcome Scratch::call(const std::string& command) const {
  const auto start = std::chrono::steady_clock::now();
  const std::string line =
      "cd '" + folder_.string() + "' && exec >.stdout 2>.stderr </dev/null && " + command;
  const int result = std::system(line.c_str());
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.status = WIFEXITED(result) ? WEXITSTATUS(result) : -1;
  outcome.out = read(".stdout");
  outcome.err = read(".stderr");
  return outcome;
}

void Scratch::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Scratch::read(const std::string& name) const {
  std::ifstream in(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_one_line(const std::string& text) {
  return text.size() > 1 && text.find('\n') == text.size() - 1;
}

double patience() {
#ifdef SEINE_SANITIZED
  return 30.0;
#else
  return 5.0;
#endif
}

std::string two_cars(const std::string& extra) {
  return "seine: 1\n"
         "world: {bounds: [-5, -1.5, 5, 1.5]}\n"
         "robots:\n"
         "  - {name: left, start: {x: -3, y: 0.6, heading: 0}, goal: {x: 3, y: 0.6, heading: 0}}\n"
         "  - {name: right, start: {x: 3, y: -0.6, heading: 3.14159}, goal: {x: -3, y: -0.6, heading: "
         "3.14159}}\n" +
         extra;
}

std::string two_cars_elsewhere() {
  std::string moved = two_cars();
  const std::string goal = "x: 3, y: 0.6";
  return moved.replace(moved.find(goal), goal.size(), "x: 3, y: 0.7");
}

}  // namespace seine::tests
