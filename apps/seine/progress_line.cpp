#include "apps/seine/progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace seine::app {
namespace {

constexpr double kPatience = 1.0;  // s before anything is drawn
constexpr double kPause = 0.1;     // s between drawings
constexpr int kBar = 24;           // characters

}  // namespace

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  clear();
}

void ProgressLine::update(const std::string& stage, double fraction) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  const double now = since_.seconds();
  if (now < kPatience || now < drawn_at_ + kPause) return;
  drawn_at_ = now;
  visible_ = true;
  std::string bar;
  if (fraction >= 0.0) {
    const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kBar);
    bar = " [" + std::string(static_cast<std::size_t>(full), '#') +
          std::string(static_cast<std::size_t>(kBar - full), '.') + "]";
  }
  std::fprintf(stderr, "\r\033[K%s%s %.1f s", stage.c_str(), bar.c_str(), now);
  std::fflush(stderr);
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  if (!visible_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  visible_ = false;
}

}  // namespace seine::app
