// One tick of the servo: take a new preset, ask the safety gate what may be sent, exchange with the devices, step,
// safety gate, record. It has no thread or clock of its own, so that servo, screenshots and tests run the same code.
// Devices, hand and gate are in the device's frame, the step and the record in the scene's (devices/placement.h).
//
// run() does not allocate, lock, throw, log or touch a file.
#pragma once

#include "devices/device_safety.h"
#include "devices/safety_gate.h"
#include "workbench/session/arming.h"
#include "workbench/session/deadline_pacer.h"
#include "workbench/session/exchange_watch.h"
#include "workbench/session/hand_lead.h"
#include "workbench/session/placed_device.h"
#include "workbench/session/servo_channels.h"
#include "workbench/session/servo_statistics.h"

#include <cstdint>
#include <memory>

namespace tangent {

/// A monotonic clock in nanoseconds; null: times are not measured and read 0.
using NanosecondClock = std::int64_t (*)() noexcept;

class ServoTick {
 public:
  /// `devices`, `channels` and `statistics` must outlive it. `rate_hz`: of the ticks. A real device's motors are as hot
  /// as an earlier one left them (motor_heat).
  ServoTick(DeviceSet& devices, ServoChannels& channels, ServoStatistics& statistics,
            std::unique_ptr<PreparedScene> scene, const PresetLetter& preset, NanosecondClock clock,
            double rate_hz = 1000.0, const PlacementLetter& placement = {});
  ~ServoTick();
  ServoTick(const ServoTick&) = delete;
  ServoTick& operator=(const ServoTick&) = delete;

  /// Runs one tick and pushes its record into the rings. One thread (the servo's) at a time.
  void run(const TickTiming& timing) noexcept;
  /// After the last tick: disarms and sends the devices zero force. Same thread as run.
  void release(double dt_s) noexcept;
  /// Before the process is suspended: as release, and forgets every wish. It may run on afterwards, disarmed.
  void suspend(double dt_s) noexcept;
  /// Finds exchanges that don't return; for a thread that is not the servo's.
  ExchangeWatch& exchange_watch() { return exchange_watch_; }
  const SafetyGate& gate() const { return gate_; }  ///< same thread as run

 private:
  void take_letters() noexcept;
  void use(const PresetLetter& letter) noexcept;
  void guard_preset(GateOutput& out, double dt_s, double solve_ns) noexcept;
  void take_force_switch() noexcept;
  void take_scene() noexcept;
  void take_placement() noexcept;
  void follow_clutch() noexcept;
  void finger_leapt() noexcept;
  void lead_hand(double dt_s, ServoRecord& record) noexcept;
  void step(TickRecord& tick) noexcept;
  void switch_surface(double dt_s, ServoRecord& record) noexcept;
  void add_pull(double dt_s, const ServoRecord& record, GateInput& input) noexcept;
  void bring_up(double dt_s, ServoRecord& record) noexcept;
  bool outside_workspace() const noexcept;
  void exchange(double dt_s, ServoRecord& record) noexcept;
  void exchange_devices(double dt_s) noexcept;
  void pass_gate(double dt_s, ServoRecord& record) noexcept;
  double declared_work(const Vec3& force, double elastic_n) noexcept;
  std::int64_t now() const noexcept { return clock_ != nullptr ? clock_() : 0; }

  DeviceSet& devices_;
  ServoChannels& channels_;
  ServoStatistics& statistics_;
  NanosecondClock clock_;
  SafetyGate gate_;
  ExchangeWatch exchange_watch_;
  PreparedScene* scene_;  ///< owned; given back through the channels when replaced
  PresetLetter preset_, incoming_;
  PresetGuard guard_;
  const PresetLetter* go_back_to_ = nullptr;  ///< from the next tick on
  PlacedDevice placed_;
  bool clutch_held_ = false;  ///< of this tick
  HandLead hand_;
  SurfaceSwitch surface_;
  TickState state_;
  std::uint64_t tick_ = 0;
  bool unready_ = false;  ///< the last tick could not search what it had to
  bool changed_ = false;  ///< another preset or scene since the last tick
  Vec3 gated_position_m_{0.0};
  std::int64_t sampled_ns_ = 0;  ///< when force_sample_ came; 0: not yet, or no clock
  ForceSample force_sample_;
  DisplaySample display_sample_;
  ForceCommand force_command_;
  DisplayCommand display_command_;
  Arming arming_;
  double force_wanted_n_ = 0.0;  ///< of the last tick
};

}  // namespace tangent
