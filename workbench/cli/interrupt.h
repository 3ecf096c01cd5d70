// Ctrl-C during long work: the first requests a stop that keeps the results so far, the second ends the program.
#pragma once

namespace tangent {

/// While it exists, SIGINT and SIGTERM only set a flag. One instance at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool requested();
};

}  // namespace tangent
