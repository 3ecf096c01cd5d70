#include "devices/simulated/simulated_contact_display.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kRollerNoise_m = 2e-3;  // of an injected fault: beyond any roller's speed at 1 kHz

DisplayCapabilities describe(const SimulatedDisplayOptions& options) {
  return {.name = "simulated contact display",
          .simulated = true,
          .travel_m = options.mechanism.travel_m,
          .resolution_m = options.mechanism.step_m,
          .bandwidth_hz = options.mechanism.bandwidth_hz,
          .rate_hz = 1.0 / CldMechanism::kPeriod_s,
          .firmware_timeout_s = 50e-3,
          .has_controller = true};
}

}  // namespace

SimulatedContactDisplay::SimulatedContactDisplay(const SimulatedDisplayOptions& options)
    : options_(options),
      capabilities_(describe(options)),
      life_(options.homing_s),
      random_(options.seed),
      mechanism_(options.mechanism) {}

void SimulatedContactDisplay::set_controller(const ControllerSettings& s) noexcept {
  mechanism_.set_gains({s.p_per_s2, s.i_per_s3, s.d_per_s, s.target_weight});
  mechanism_.set_limits({s.lowest_m, s.highest_m, s.fastest_m_per_s, s.largest_current_a});
}

DisplaySample SimulatedContactDisplay::measure(double dt_s) noexcept {
  age_s_ += dt_s;
  const double held_s = std::max(0.0, since_control_s_);  // the controller reads its encoder when it runs
  const bool lost = life_.injected() == InjectedFault::drop_out || life_.injected() == InjectedFault::delay_burst;
  if (!lost && life_.injected() != InjectedFault::stuck_encoder) shown_m_ = mechanism_.encoder_m();
  if (life_.injected() == InjectedFault::noise) {
    shown_m_ += kRollerNoise_m * (2.0 * static_cast<double>(random_() >> 11) * 0x1p-53 - 1.0);
  }
  if (!lost) age_s_ = held_s;
  return {.position_m = shown_m_, .age_s = age_s_, .state = life_.state(), .fault = life_.fault()};
}

DisplaySample SimulatedContactDisplay::exchange(const DisplayCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  life_.update(command.request, std::isfinite(command.target_m), dt_s);
  const bool moves = life_.ready() || life_.state() == DeviceState::homing;
  const double target = life_.ready() ? command.target_m : 0.0;
  since_control_s_ += dt_s;
  // A little early, so that a step of a period that was rounded down is one.
  while (since_control_s_ > (1.0 - 1e-6) * CldMechanism::kPeriod_s) {
    since_control_s_ -= CldMechanism::kPeriod_s;
    if (!moves)
      mechanism_.hold();
    else if (life_.injected() == InjectedFault::stuck_encoder)
      mechanism_.control(target, shown_m_);
    else
      mechanism_.control(target);
  }
  return measure(dt_s);
}

}  // namespace tangent
