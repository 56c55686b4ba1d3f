#pragma once

namespace seine::app {

/// From now on Ctrl-C (or a request to terminate) ends the program at once with one line on stderr and the
/// exit status "no". Nothing is left half done: files are written in one go under another name, result lines
/// are flushed one by one.
void end_on_interrupt();

}  // namespace seine::app
