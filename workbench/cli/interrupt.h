// Ctrl-C during long work: the first asks the work to stop and keep what is done, the second ends the program.
#pragma once

namespace tangent {

/// While one lives, SIGINT and SIGTERM only raise a flag. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool requested();
};

}  // namespace tangent
