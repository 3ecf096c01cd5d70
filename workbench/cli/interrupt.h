// Ctrl-C, a closed terminal and a polite kill during long work: the first requests a stop that keeps the results so
// far, the second ends the program.
#pragma once

#include <csignal>

#include <array>

namespace tangent {

/// While it exists, SIGINT, SIGTERM and SIGHUP only set a flag, and end the servos, which send zero force first
/// (session/crash_stop.h). One that was ignored before (nohup) stays so. One instance at a time; it begins before the
/// work's first file is made and ends after the last one is in place.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool requested();

 private:
  std::array<struct sigaction, 3> before_{};
};

}  // namespace tangent
