// One tick of the servo: take a new preset, exchange with the devices, step, safety gate, device command, record. It
// has no thread or clock of its own, so that servo, screenshots and tests run the same code.
//
// run() does not allocate, lock, throw, log or touch a file.
#pragma once

#include "devices/device_set.h"
#include "devices/safety_gate.h"
#include "workbench/session/arming.h"
#include "workbench/session/deadline_pacer.h"
#include "workbench/session/hand_lead.h"
#include "workbench/session/servo_channels.h"
#include "workbench/session/servo_statistics.h"

#include <cstdint>
#include <memory>

namespace tangent {

/// A monotonic clock in nanoseconds; null: times are not measured and read 0.
using NanosecondClock = std::int64_t (*)() noexcept;

/// Limits of the safety gate for these devices.
GateLimits gate_limits(const DeviceSet& devices);

class ServoTick {
 public:
  /// `devices`, `channels` and `statistics` must outlive it.
  ServoTick(DeviceSet& devices, ServoChannels& channels, ServoStatistics& statistics,
            std::unique_ptr<PreparedScene> scene, const PresetLetter& preset, NanosecondClock clock);
  ~ServoTick();
  ServoTick(const ServoTick&) = delete;
  ServoTick& operator=(const ServoTick&) = delete;

  /// Runs one tick and pushes its record into the rings. One thread (the servo's) at a time.
  void run(const TickTiming& timing) noexcept;
  /// After the last tick: disarms and sends the devices zero force. Same thread as run.
  void release(double dt_s) noexcept;

 private:
  void take_letters() noexcept;
  void take_force_switch() noexcept;
  void take_scene() noexcept;
  void place_workspace() noexcept;
  void bring_up(double dt_s, ServoRecord& record) noexcept;
  bool outside_workspace() const noexcept;
  void exchange(double dt_s, ServoRecord& record) noexcept;
  void gate(double dt_s, ServoRecord& record) noexcept;
  std::int64_t now() const noexcept { return clock_ != nullptr ? clock_() : 0; }

  DeviceSet& devices_;
  ServoChannels& channels_;
  ServoStatistics& statistics_;
  NanosecondClock clock_;
  SafetyGate gate_;
  PreparedScene* scene_;  ///< owned; given back through the channels when replaced
  PresetLetter preset_;
  HandLead hand_;
  TickState state_;
  std::uint64_t tick_ = 0;
  ForceSample force_sample_;
  DisplaySample display_sample_;
  ForceCommand force_command_;
  DisplayCommand display_command_;
  Arming arming_;
  Vec3 workspace_centre_m_{0.0};
  double force_wanted_n_ = 0.0;  ///< of the last tick
};

}  // namespace tangent
