// The record of a servo tick: the tick itself, devices and safety gate, and timing. One type for the GUI's ring, the
// recorder's ring and the history.
#pragma once

#include "core/tick/step.h"
#include "devices/device_state.h"
#include "devices/safety_gate.h"
#include "workbench/session/arming.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace tangent {

/// Devices and safety gate as seen by one tick. The scene's frame, SI (devices/placement.h).
struct DeviceTelemetry {
  DeviceState force_state = DeviceState::absent;
  DeviceFault force_fault = DeviceFault::none;
  DeviceState display_state = DeviceState::absent;
  DeviceFault display_fault = DeviceFault::none;
  GateState gate_state = GateState::disarmed;
  GateFault gate_fault = GateFault::none;
  GateActions gate_actions = 0;  ///< bit per GateAction
  ArmingStage arming = ArmingStage::idle;
  ArmingObstacle in_the_way = ArmingObstacle::none;
  std::uint8_t hand_led = 0;       ///< 1: a simulated hand leads the finger; hand_target_m is set
  std::uint8_t surface_waits = 0;  ///< 1: it is felt as soon as the finger is off it
  float surface_share = 1.0F;      ///< of the surface that is felt (surface_switch.h)
  Vec3 force_command_n{0.0};       ///< tick.output.force_n after the gate; sent in the next tick if that isn't late
  Vec3 force_rendered_n{0.0};      ///< applied by the device while this tick's position was measured
  Vec3 hand_target_m{0.0};         ///< target of the simulated hand
  double cld_command_m = 0.0;      ///< tick.output.cld_m after the safety gate
  double cld_measured_m = 0.0;     ///< roller position, measured at the start of this tick
  double force_age_s = 0.0;        ///< age of this tick's position
  double display_age_s = 0.0;      ///< age of cld_measured_m
  std::uint32_t buttons = 0;       ///< of the force device, pressed: bit per button
  double energy_j = 0.0;           ///< observed: > 0 made by the loop, < 0 stored by the hand (EnergyWatch::net_j)
};

/// What a tick would push with if it were let: the larger of the force it decided to and of the one faded in.
inline double force_wanted_n(const TickOutput& output) {
  return std::sqrt(
      std::max(glm::dot(output.force_n, output.force_n), glm::dot(output.decided_force_n, output.decided_force_n)));
}

struct ServoRecord {
  TickRecord tick;  ///< tick.solve_ns: the solver step only; tick.tick counts from 0
  DeviceTelemetry device;
  std::uint32_t scene_id = 0;          ///< scene the tick ran on (Session::scene)
  std::uint32_t missed_deadlines = 0;  ///< deadlines skipped before this tick
  double tick_ns = 0.0;                ///< whole tick: exchange, step, gate
  double period_ns = 0.0;              ///< start to start; 0 for the first tick
  double lateness_ns = 0.0;            ///< start minus the deadline waited for; includes skipped periods
  double latency_ns = 0.0;             ///< age of the finger's position in the command that this tick sent; 0: no clock
};
static_assert(std::is_trivially_copyable_v<ServoRecord>);

}  // namespace tangent
