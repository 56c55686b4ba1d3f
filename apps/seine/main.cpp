// The command line of Seine: reads the arguments, runs one subcommand, turns every failure into one line and
// an exit status.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "apps/seine/command.hpp"
#include "apps/seine/interrupt.hpp"
#include "apps/seine/output.hpp"
#include "seine/base/error.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/report.hpp"
#include "seine/io/suggestion.hpp"

namespace {

using seine::app::Invocation;

constexpr const char* kFooter = R"(Examples
  seine generate random --robots 8 --seed 1 -o team.yaml      make a task
  seine check team.yaml                                       is the task sound? starts, goals, ways, slips
  seine plan team.yaml -o plan.json                           plan it; exit status 0 says: certified
  seine simulate team.yaml plan.json --noise low              drive it
  seine plot team.yaml plan.json -o plan.svg                  look at it
  seine certify team.yaml plan.json                           prove any plan, also an edited one
  seine export team.yaml plan.json --rate 50 -o states.csv    what every car does, 50 times a second
Files: - is the standard input or output; what a command reads it never writes over.
Exit status: 0 done (plan: certified; simulate: everything asked for happened), 1 no (no certified plan, refuted),
2 wrong input or usage, or an output that cannot be written, 3 undecided (a proof out of time), 130 interrupted.
`seine COMMAND --help` tells more.)";

/// One line on stderr, and with --json also an object on stdout.
int fail(const Invocation& invocation, std::string message, int status) {
  constexpr std::size_t kLongest = 600;
  std::replace(message.begin(), message.end(), '\n', ' ');
  message = seine::io::printable(message, kLongest);
  std::fprintf(stderr, "seine: %s\n", message.c_str());
  if (invocation.json && !seine::io::write_all(STDOUT_FILENO, seine::io::failure_json(message)))
    return seine::app::kWrong;
  return status;
}

/// What is wrong with the command line: the word that is unknown, with the nearest that is not.
std::string wrong_usage(CLI::App& program, int argc, char** argv, const std::string& usual) {
  constexpr const char* kHelp = " (try --help)";
  if (argc < 2) return usual + kHelp;
  const std::string first = argv[1];
  const std::vector<CLI::App*> commands = program.get_subcommands({});
  const auto found =
      std::ranges::find(commands, first, [](const CLI::App* known) { return known->get_name(); });
  const CLI::App* command = found == commands.end() ? nullptr : *found;
  std::vector<std::string> names;
  if (command == nullptr && !first.starts_with("-")) {
    for (const CLI::App* known : commands) names.push_back(known->get_name());
    return "there is no command '" + first + "'" +
           seine::app::suggested(first, {names.begin(), names.end()}) + kHelp;
  }
  const CLI::App& asked = command != nullptr ? *command : program;
  for (const CLI::Option* option : asked.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || word == "--" || std::ranges::find(names, word) != names.end()) continue;
    return "there is no option '" + word + "'" + seine::io::did_you_mean(word, {names.begin(), names.end()}) +
           kHelp;
  }
  return usual + kHelp;
}

/// Help or the version.
int answered(CLI::App& program, const CLI::Success& answer) {
  std::ostringstream out;
  program.exit(answer, out, out);
  try {
    seine::app::print(out.str());
  } catch (const seine::InputError& error) {
    std::fprintf(stderr, "seine: %s\n", error.what());
    return seine::app::kWrong;
  }
  return seine::app::kDone;
}

int run(const Invocation& invocation) {
  try {
    return invocation.run();
  } catch (const seine::app::StdoutIsRead& error) {
    return fail({}, error.what(), seine::app::kWrong);
  } catch (const seine::InputError& error) {
    return fail(invocation, error.what(), seine::app::kWrong);
  } catch (const std::bad_alloc&) {
    return fail(invocation,
                "out of memory: the task takes more than 4 GiB, or more than the machine has; a coarser map, "
                "fewer obstacles or larger cars need less",
                seine::app::kWrong);
  } catch (const std::exception& error) {
    return fail(invocation, std::string("internal error: ") + error.what(), seine::app::kNo);
  }
}

// A task that asks for more ends in one line, not in a machine that swaps. (Sanitizers need far more.)
void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  constexpr rlim_t kMost = rlim_t{4} << 30;
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= kMost) return;
  limit.rlim_cur = kMost;
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program(
      "Seine plans the motion of teams of car-like robots; every plan it gives out is proved in continuous "
      "time.",
      "seine");
  program.footer(kFooter);
  program.set_version_flag("--version", "seine " SEINE_VERSION);
  program.require_subcommand(1);
  Invocation invocation;
  seine::app::add_plan(program, invocation);
  seine::app::add_check(program, invocation);
  seine::app::add_certify(program, invocation);
  seine::app::add_simulate(program, invocation);
  seine::app::add_plot(program, invocation);
  seine::app::add_export(program, invocation);
  seine::app::add_generate(program, invocation);
  seine::app::add_bench(program, invocation);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& answer) {  // --help, --version
    return answered(program, answer);
  } catch (const CLI::ParseError& error) {
    return fail(invocation, wrong_usage(program, argc, argv, error.what()), seine::app::kWrong);
  }
  limit_memory();
  seine::app::end_on_interrupt();
  return run(invocation);
}
