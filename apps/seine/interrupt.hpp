#pragma once

#include <atomic>

namespace seine::app {

/// From now on Ctrl-C (or a request to terminate, or a terminal that is closed) ends the program at once with
/// one line on stderr and the exit status 128 plus the signal's number: 130 for Ctrl-C. Nothing is left half
/// done: files are written in one go, result lines one by one.
void end_on_interrupt();

/// From now on the first of these signals only raises the flag that is returned, for work that then gives out
/// what it has. The second ends the program at once, and so does a few seconds without an end.
const std::atomic<bool>& wind_up_on_interrupt();

/// The exit status of a program that wound up; 0 when nothing has interrupted it.
int interrupted_status();

}  // namespace seine::app
