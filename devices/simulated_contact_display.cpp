#include "devices/simulated_contact_display.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

namespace {

double rounded(double v, double step) { return step > 0.0 ? std::round(v / step) * step : v; }

DisplayCapabilities describe(const SimulatedDisplayOptions& options) {
  return {.name = "simulated contact display",
          .simulated = true,
          .travel_m = options.travel_m,
          .resolution_m = options.step_m,
          .bandwidth_hz = options.bandwidth_hz,
          .rate_hz = 1000.0};
}

}  // namespace

SimulatedContactDisplay::SimulatedContactDisplay(const SimulatedDisplayOptions& options)
    : options_(options), capabilities_(describe(options)) {}

Status SimulatedContactDisplay::open() {
  if (!machine_.enter(DeviceState::open)) return fail("is already open", capabilities_.name, "close it first");
  return {};
}

void SimulatedContactDisplay::close() { machine_.enter(DeviceState::absent); }

void SimulatedContactDisplay::update_state(const DisplayCommand& command, double dt_s) noexcept {
  if (injected_ != DeviceFault::none) {
    machine_.fail(injected_);
    injected_ = DeviceFault::none;
  }
  if (machine_.state() == DeviceState::homing) {
    homing_for_s_ += dt_s;
    if (homing_for_s_ >= options_.homing_s) machine_.enter(DeviceState::ready);
  }
  if (machine_.apply(command.request) && machine_.state() == DeviceState::homing) homing_for_s_ = 0.0;
  if (machine_.ready() && !std::isfinite(command.target_m)) machine_.fail(DeviceFault::bad_command);
}

// x'' = w^2 (target - x) - 2 z w x' with z = 1/sqrt(2), where the -3 dB bandwidth is w itself. The target stands
// still during a tick, so the step is the exact solution: with y = x - target and a = w / sqrt(2),
//   y(t) = e^{-a t} (y0 cos a t + (v0 / a + y0) sin a t),   y'(t) = e^{-a t} (v0 cos a t - (v0 + 2 a y0) sin a t).
void SimulatedContactDisplay::follow(double target, double dt_s) noexcept {
  const double a = 2.0 * std::numbers::pi * options_.bandwidth_hz / std::numbers::sqrt2;
  const double decay = std::exp(-a * dt_s), c = std::cos(a * dt_s), s = std::sin(a * dt_s);
  const double y = position_ - target, v = velocity_;
  position_ = target + decay * (y * c + (v / a + y) * s);
  velocity_ = decay * (v * c - (v + 2.0 * a * y) * s);
  const double end = 0.5 * options_.travel_m;
  if (std::abs(position_) > end) {
    position_ = std::copysign(end, position_);
    velocity_ = 0.0;
  }
}

DisplaySample SimulatedContactDisplay::exchange(const DisplayCommand& command, double dt_s) noexcept {
  update_state(command, dt_s);
  if (machine_.ready()) {
    const double end = 0.5 * options_.travel_m;
    follow(rounded(std::clamp(command.target_m, -end, end), options_.step_m), dt_s);
  } else if (machine_.state() == DeviceState::homing) {
    follow(0.0, dt_s);
  } else {
    velocity_ = 0.0;
  }
  return {.position_m = rounded(position_, options_.step_m), .state = machine_.state(), .fault = machine_.fault()};
}

}  // namespace tangent
