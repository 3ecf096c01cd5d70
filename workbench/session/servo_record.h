// What a servo tick tells its watchers: the tick itself, what the devices did, and how long it took. One type for
// the GUI's ring, the recorder's ring and the history.
#pragma once

#include "core/tick/step.h"
#include "devices/device_state.h"
#include "devices/safety_gate.h"

#include <cstdint>
#include <type_traits>

namespace tangent {

/// Devices and safety gate as seen by one tick. World frame, SI.
struct DeviceTelemetry {
  DeviceState force_state = DeviceState::absent;
  DeviceFault force_fault = DeviceFault::none;
  DeviceState display_state = DeviceState::absent;
  DeviceFault display_fault = DeviceFault::none;
  GateState gate_state = GateState::disarmed;
  GateFault gate_fault = GateFault::none;
  GateActions gate_actions = 0;  ///< bit per GateAction
  std::uint8_t hand_led = 0;     ///< hand_target_m is set: a simulated hand leads the finger
  Vec3 force_command_n{0.0};     ///< what the gate let through of tick.output.force_n
  Vec3 force_rendered_n{0.0};    ///< by the device while this tick's position was measured
  Vec3 hand_target_m{0.0};       ///< where the simulated hand pulls the finger
  double cld_command_m = 0.0;    ///< what the gate let through of tick.output.cld_m
  double cld_measured_m = 0.0;   ///< roller, measured as this tick began
  double force_age_s = 0.0;      ///< of the position this tick worked with
  double display_age_s = 0.0;    ///< of cld_measured_m
};

struct ServoRecord {
  TickRecord tick;  ///< tick.solve_ns: the step alone; tick.tick counts from 0
  DeviceTelemetry device;
  std::uint32_t scene_id = 0;          ///< which scene the tick ran on (Session::scene)
  std::uint32_t missed_deadlines = 0;  ///< skipped before this tick
  double tick_ns = 0.0;                ///< whole tick: exchange, step, gate
  double period_ns = 0.0;              ///< start to start, since the tick before; 0 for the first
  double lateness_ns = 0.0;            ///< start after the deadline waited for, skipped ones included
};
static_assert(std::is_trivially_copyable_v<ServoRecord>);

}  // namespace tangent
