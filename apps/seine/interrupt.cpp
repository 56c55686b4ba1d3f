#include "apps/seine/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <string_view>

#include "apps/seine/command.hpp"

namespace seine::app {
namespace {

constexpr unsigned kPatience = 3;  // s from the first signal on

volatile sig_atomic_t terminal = 0;
std::atomic<bool> raised{false}, patient{false};
std::atomic<int> first{0};  // the signal that came first
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// Only what a signal handler may call: write, alarm and _exit.
extern "C" void handle(int number) {
  if (first == 0) first = number;
  if (patient && !raised.exchange(true)) {
    ::alarm(kPatience);
    return;
  }
  constexpr std::string_view kClear = "\r\033[K", kMessage = "seine: interrupted\n";
  if (terminal != 0) static_cast<void>(!::write(STDERR_FILENO, kClear.data(), kClear.size()));
  static_cast<void>(!::write(STDERR_FILENO, kMessage.data(), kMessage.size()));
  ::_exit(kSignal + first);
}

}  // namespace

void end_on_interrupt() {
  terminal = ::isatty(STDERR_FILENO);
  struct sigaction action {};
  action.sa_handler = handle;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) {
    struct sigaction before {};
    ::sigaction(number, nullptr, &before);
    if (number != SIGHUP || before.sa_handler != SIG_IGN)
      ::sigaction(number, &action, nullptr);  // nohup stays nohup
  }
  // A limit on the size of files is told like a full disk.
  ::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& wind_up_on_interrupt() {
  patient = true;
  return raised;
}

int interrupted_status() {
  return raised ? kSignal + first : 0;
}

}  // namespace seine::app
