// Standard input that gives single keys without echo, and gets its old settings back however the process ends or is
// suspended: crash_stop.h calls the two functions below from its signal handlers.
#pragma once

#include <termios.h>

namespace tangent {

class RawTerminal {
 public:
  /// Does nothing where standard input is no terminal. One at a time.
  RawTerminal() noexcept;
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  bool active() const { return active_; }

 private:
  friend void give_terminal_back() noexcept;
  friend void take_terminal_again() noexcept;
  termios before_{}, raw_{};
  bool active_ = false;
};

/// While a RawTerminal exists; any thread, and in a signal handler. A process in the background leaves it alone: to set
/// it would stop the process.
void give_terminal_back() noexcept;
void take_terminal_again() noexcept;

}  // namespace tangent
