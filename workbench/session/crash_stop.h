// Zero force before the process ends out of order: by a signal, a crash in any thread, an allocation that fails, or an
// exit() inside a library (Xlib calls it when its server is gone). And before it is suspended (Ctrl-Z): then nobody
// sends anything, and it goes on disarmed. SIGSTOP can't be caught; after it the gate finds a late tick.
//
// A flag asks every servo thread to send zero force and end, and each says when it has. Who waits for that uses atomics
// and sleeps, and so may be a signal handler. Nothing in this process helps against SIGKILL (the kernel's own, when
// memory is out): there the device's firmware stops by its time-out. workbench/README.md says why there is no second
// process.
#pragma once

#include <atomic>

namespace tangent {

inline constexpr int kLinkWait_ms = 20;   ///< a command is on the cable within a few ms
inline constexpr int kMostWait_ms = 100;  ///< for servos to send zero force, before the process ends anyway

/// Any thread, and in a signal handler.
void ask_servos_to_end() noexcept;
bool servos_are_to_end() noexcept;
/// Asks, and waits until they have, at most kMostWait_ms. On a servo's own thread it sends zero force itself. False:
/// some have not. Any thread, and in a signal handler.
bool end_servos() noexcept;
/// From now on end_servos waits kLinkWait_ms more, once the servos have ended: the drivers of devices on a cable send
/// the last command from a thread of their own.
void wait_for_links() noexcept;
/// While the process is about to be suspended: servos send zero force and wait, disarmed. Any thread.
bool servos_are_to_wait() noexcept;
/// Servos that start from now on run.
void allow_servos() noexcept;

/// A servo that may send force, from start to end.
class RunningServo {
 public:
  /// `release(servo)` sends zero force.
  RunningServo(void (*release)(void*) noexcept, void* servo) noexcept;
  ~RunningServo() { ended(); }
  RunningServo(const RunningServo&) = delete;
  RunningServo& operator=(const RunningServo&) = delete;
  /// It has sent zero force and sends no other any more.
  void ended() noexcept;
  /// It has sent zero force, and sends no other before it goes on.
  void waits() noexcept;
  void goes_on() noexcept;

  /// On the thread that runs it: where that very thread crashes, the signal handler calls `release`.
  class Here {
   public:
    explicit Here(RunningServo& servo) noexcept;
    ~Here();
    Here(const Here&) = delete;
    Here& operator=(const Here&) = delete;
  };

 private:
  friend bool end_servos() noexcept;
  std::atomic<bool> waiting_{false};
  void (*release_)(void*) noexcept;
  void* servo_;
  std::atomic<bool> running_{true};
};

/// So that a handler can run on this thread where its own stack has overflown; while it exists.
class AlternateStack {
 public:
  AlternateStack() noexcept;
  ~AlternateStack();
  AlternateStack(const AlternateStack&) = delete;
  AlternateStack& operator=(const AlternateStack&) = delete;

 private:
  unsigned char* bytes_;
};

/// For the program's main thread, once: every signal that ends the process by default first calls end_servos, removes
/// files that are half written and gives the terminal back, as does exit(); every one that suspends it first has the
/// servos wait. Signals that are handled or ignored already stay so.
void install_crash_stop();
/// On a servo's thread: signals that suspend the process are handled on another one, which waits for this one.
void leave_suspending_to_others() noexcept;

}  // namespace tangent
