#include "devices/simulated/simulated_contact_display.h"

#include <cmath>

namespace tangent {

namespace {

constexpr double kNoise_m = 2e-3;   // of an injected fault: beyond any roller's speed at 1 kHz

DisplayCapabilities describe(const SimulatedDisplayOptions& options) {
  return {.name = "simulated contact display",
          .simulated = true,
          .travel_m = options.mechanism.travel_m,
          .resolution_m = options.mechanism.step_m,
          .bandwidth_hz = options.mechanism.bandwidth_hz,
          .rate_hz = 1.0 / CldMechanism::kPeriod_s,
          .firmware_timeout_s = 50e-3};
}

}  // namespace

SimulatedContactDisplay::SimulatedContactDisplay(const SimulatedDisplayOptions& options)
    : options_(options), capabilities_(describe(options)), random_(options.seed), mechanism_(options.mechanism) {}

Status SimulatedContactDisplay::open() {
  if (!machine_.enter(DeviceState::open)) return fail("is already open", capabilities_.name, "close it first");
  return {};
}

void SimulatedContactDisplay::close() { machine_.enter(DeviceState::absent); }

bool SimulatedContactDisplay::inject(const FaultInjection& fault) noexcept {
  timer_.begin(fault);
  return true;
}

void SimulatedContactDisplay::update_state(const DisplayCommand& command, double dt_s) noexcept {
  fault_now_ = timer_.next();
  if (fault_now_ == InjectedFault::drop_out) machine_.fail(DeviceFault::disconnected);
  if (next_fault_ != DeviceFault::none) {
    machine_.fail(next_fault_);
    next_fault_ = DeviceFault::none;
  }
  if (machine_.state() == DeviceState::open) machine_.enter(DeviceState::firmware);   // says who it is at once
  if (machine_.state() == DeviceState::homing) {
    homing_for_s_ += dt_s;
    if (homing_for_s_ >= options_.homing_s) machine_.enter(DeviceState::ready);
  }
  const bool answers = fault_now_ != InjectedFault::drop_out;
  if (answers && machine_.apply(command.request) && machine_.state() == DeviceState::homing) homing_for_s_ = 0.0;
  if (machine_.ready() && !std::isfinite(command.target_m)) machine_.fail(DeviceFault::bad_command);
}

DisplaySample SimulatedContactDisplay::measure(double dt_s) noexcept {
  age_s_ += dt_s;
  const bool lost = fault_now_ == InjectedFault::drop_out || fault_now_ == InjectedFault::delay_burst;
  if (!lost && fault_now_ != InjectedFault::stuck_encoder) shown_m_ = mechanism_.encoder_m();
  if (fault_now_ == InjectedFault::noise) {
    shown_m_ += kNoise_m * (2.0 * static_cast<double>(random_() >> 11) * 0x1p-53 - 1.0);
  }
  if (!lost) age_s_ = 0.0;
  return {.position_m = shown_m_, .age_s = age_s_, .state = machine_.state(), .fault = machine_.fault()};
}

DisplaySample SimulatedContactDisplay::exchange(const DisplayCommand& command, double dt_s) noexcept {
  update_state(command, dt_s);
  const bool moves = machine_.ready() || machine_.state() == DeviceState::homing;
  const double target = machine_.ready() ? command.target_m : 0.0;
  since_control_s_ += dt_s;
  // Half a period of tolerance, so that rounding of many small steps loses none.
  while (since_control_s_ > 0.5 * CldMechanism::kPeriod_s) {
    since_control_s_ -= CldMechanism::kPeriod_s;
    if (!moves) mechanism_.hold();
    else if (fault_now_ == InjectedFault::stuck_encoder) mechanism_.control(target, shown_m_);
    else mechanism_.control(target);
  }
  return measure(dt_s);
}

}  // namespace tangent
