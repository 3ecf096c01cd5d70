// Zero force before the process ends out of order: by a signal, a crash in any thread, an allocation that fails, or an
// exit() inside a library (Xlib calls it when its server is gone).
//
// A flag asks every servo thread to send zero force and end, and each says when it has. Who waits for that uses atomics
// and sleeps, and so may be a signal handler. Nothing in this process helps against SIGKILL (the kernel's own, when
// memory is out): there the device's firmware stops by its time-out. workbench/README.md says why there is no second
// process.
#pragma once

namespace tangent {

inline constexpr int kMostWait_ms = 100;  ///< for servos to send zero force, before the process ends anyway

/// Any thread, and in a signal handler.
void ask_servos_to_end() noexcept;
bool servos_are_to_end() noexcept;
/// Asks, and waits until they have, at most kMostWait_ms. On a servo's own thread it sends zero force itself. False:
/// some have not. Any thread, and in a signal handler.
bool end_servos() noexcept;
/// Servos that start from now on run.
void allow_servos() noexcept;

/// Held by a servo's thread, for as long as it may send force. `release(servo)` sends zero force; it is called, from a
/// signal handler, where this very thread crashes.
class RunningServo {
 public:
  RunningServo(void (*release)(void*) noexcept, void* servo) noexcept;
  ~RunningServo();
  RunningServo(const RunningServo&) = delete;
  RunningServo& operator=(const RunningServo&) = delete;
};

/// For the program's main thread, once: every signal that ends the process by default first calls end_servos and
/// removes files that are half written, as does exit(). Signals that are handled or ignored already stay so.
void install_crash_stop();

}  // namespace tangent
