// Runs the ticks: in the servo thread, at a fixed rate, by absolute deadlines; or, with a force device that keeps the
// time, when it calls, in its thread. With real devices a second thread watches that their exchanges return. All calls
// come from the owner's thread.
#pragma once

#include "devices/force_device.h"
#include "workbench/session/call_pacer.h"
#include "workbench/session/crash_stop.h"
#include "workbench/session/deadline_pacer.h"
#include "workbench/session/servo_clock.h"
#include "workbench/session/servo_options.h"
#include "workbench/session/servo_tick.h"

#include <atomic>
#include <optional>
#include <thread>

namespace tangent {

class Servo {
 public:
  /// `tick`, `statistics`, `clock` and `scheduler` must outlive it. `scheduler`: a force device that calls us; null:
  /// the servo keeps the time. Precondition: rate within kSlowestServoHz, kFastestServoHz.
  Servo(ServoTick& tick, ServoStatistics& statistics, const ServoOptions& options, ServoClock& clock,
        ForceDevice* scheduler = nullptr);
  ~Servo();
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  /// Starts the thread, or the device's calls; does nothing when it runs already. Fails when the device can't start.
  Status start();
  /// Stops after the current tick, sends the devices zero force, and joins the thread. False: an exchange has not
  /// returned for options.longest_stop_s, although its device was told to stop by its own way. The thread is left in
  /// it; should it return, the thread sends zero force and ends. Until then neither this nor anything that it was given
  /// may be destroyed (the destructor waits).
  bool stop();
  /// After stop has returned false, where nothing of this is ever destroyed: its threads end by themselves.
  void leave_behind() noexcept;
  bool running() const { return thread_.joinable() || called_; }
  RealtimeGrant granted() const { return {fifo_.load(), locked_.load(), on_cpu_.load()}; }  ///< any thread

  /// Runs the next tick now, in the caller's thread, as if it began at its deadline. Precondition: not running.
  void run_one() noexcept;

 private:
  void loop() noexcept;
  void run_called() noexcept;
  void wait_suspended(RunningServo& running) noexcept;
  bool in_exchange_for_good() noexcept;
  Status start_called();
  bool ends() const noexcept;
  void watch() noexcept;
  static void release_one(void* servo) noexcept { static_cast<Servo*>(servo)->release(); }
  void release() noexcept { tick_.release(1.0 / options_.rate_hz); }
  void ask_for_realtime() noexcept;

  ServoTick& tick_;
  ServoStatistics& statistics_;
  ServoOptions options_;
  ServoClock& clock_;
  DeadlinePacer pacer_;
  CallPacer call_pacer_;
  ForceDevice* scheduler_;
  bool called_ = false;                  ///< by the device
  std::optional<RunningServo> running_;  ///< while it is
  std::thread thread_, watching_thread_;
  std::atomic<bool> stopping_{false}, watching_{false};
  std::atomic<bool> ended_{false};    ///< the thread's last exchange was made
  std::atomic<bool> in_call_{false};  ///< of a device that calls us
  std::atomic<bool> fifo_{false}, locked_{false}, on_cpu_{false};
};

}  // namespace tangent
