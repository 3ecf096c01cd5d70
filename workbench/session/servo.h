// The servo thread: runs ticks at a fixed rate, by absolute deadlines. All calls come from the owner's thread.
#pragma once

#include "workbench/session/deadline_pacer.h"
#include "workbench/session/servo_clock.h"
#include "workbench/session/servo_options.h"
#include "workbench/session/servo_tick.h"

#include <atomic>
#include <thread>

namespace tangent {

class Servo {
 public:
  /// `tick`, `statistics` and `clock` must outlive it. Precondition: rate within kSlowestServoHz, kFastestServoHz.
  Servo(ServoTick& tick, ServoStatistics& statistics, const ServoOptions& options, ServoClock& clock);
  ~Servo() { stop(); }
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  /// Starts the thread; does nothing when it runs already.
  void start();
  /// Stops after the current tick, sends the devices zero force, and joins the thread.
  void stop();
  bool running() const { return thread_.joinable(); }
  RealtimeGrant granted() const { return {fifo_.load(), locked_.load(), on_cpu_.load()}; }  ///< any thread

  /// Runs the next tick now, in the caller's thread, as if it began at its deadline. Precondition: not running.
  void run_one() noexcept;

 private:
  void loop() noexcept;
  static void release_one(void* servo) noexcept { static_cast<Servo*>(servo)->release(); }
  void release() noexcept { tick_.release(1.0 / options_.rate_hz); }
  void ask_for_realtime() noexcept;

  ServoTick& tick_;
  ServoStatistics& statistics_;
  ServoOptions options_;
  ServoClock& clock_;
  DeadlinePacer pacer_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> fifo_{false}, locked_{false}, on_cpu_{false};
};

}  // namespace tangent
