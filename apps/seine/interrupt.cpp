#include "apps/seine/interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "apps/seine/command.hpp"

namespace seine::app {
namespace {

volatile std::sig_atomic_t terminal = 0;

// Only what a signal handler may call: write and _exit.
extern "C" void leave(int) {
  constexpr std::string_view kClear = "\r\033[K", kMessage = "seine: interrupted\n";
  if (terminal != 0) static_cast<void>(!::write(STDERR_FILENO, kClear.data(), kClear.size()));
  static_cast<void>(!::write(STDERR_FILENO, kMessage.data(), kMessage.size()));
  ::_exit(kNo);
}

}  // namespace

void end_on_interrupt() {
  terminal = ::isatty(STDERR_FILENO);
  std::signal(SIGINT, leave);
  std::signal(SIGTERM, leave);
}

}  // namespace seine::app
