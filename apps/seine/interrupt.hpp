#pragma once

#include <atomic>
#include <exception>

namespace seine::app {

/// True once the user pressed Ctrl-C (or the program was asked to terminate). The first time asks politely;
/// the second kills.
const std::atomic<bool>& interrupted();
void catch_interrupts();

/// Thrown out of a computation that was interrupted.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace seine::app
