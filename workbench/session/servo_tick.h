// One tick of the servo, from what came in to what goes out: preset, device sample, step, safety gate, device
// command, record. No thread and no clock of its own, so that the servo, pictures and tests run the same code.
//
// Nothing in run() allocates, locks, throws, logs or touches a file.
#pragma once

#include "devices/device_set.h"
#include "devices/safety_gate.h"
#include "workbench/session/deadline_pacer.h"
#include "workbench/session/hand_lead.h"
#include "workbench/session/servo_channels.h"
#include "workbench/session/servo_statistics.h"

#include <cstdint>
#include <memory>

namespace tangent {

/// Nanoseconds of a monotonic clock; null: time is not measured and reads 0.
using NanosecondClock = std::int64_t (*)() noexcept;

/// What the gate has to know of the devices.
GateLimits gate_limits(const DeviceSet& devices);

class ServoTick {
 public:
  /// `devices`, `channels` and `statistics` must outlive it.
  ServoTick(DeviceSet& devices, ServoChannels& channels, ServoStatistics& statistics,
            std::unique_ptr<PreparedScene> scene, const PresetLetter& preset, NanosecondClock clock);
  ~ServoTick();
  ServoTick(const ServoTick&) = delete;
  ServoTick& operator=(const ServoTick&) = delete;

  /// One tick; its record goes into the rings.
  void run(const TickTiming& timing) noexcept;
  /// Zero force to the devices, force disarmed: after the last tick.
  void release(double dt_s) noexcept;

 private:
  void take_letters() noexcept;
  void take_scene() noexcept;
  void place_workspace() noexcept;
  void bring_up() noexcept;
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
  bool homing_wanted_ = true;     ///< until every device is ready once
  bool clearing_wanted_ = false;  ///< faults too
  bool rehoming_wanted_ = false;  ///< also of devices that are ready
  bool arming_wanted_ = false;    ///< as soon as they are
};

}  // namespace tangent
