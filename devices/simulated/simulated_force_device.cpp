#include "devices/simulated/simulated_force_device.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

namespace {

constexpr double kTremorHz = 9.0;       // physiological tremor of the hand: 8 to 12 Hz
constexpr double kTremorDamping = 0.2;  // damping ratio; smaller: closer to a pure tone
constexpr double kNoise_m = 20e-3;      // of an injected fault: jumps faster than any hand

ForceCapabilities describe(const SimulatedForceOptions& options) {
  ForceCapabilities c;
  c.name = "simulated force device";
  c.simulated = true;
  c.senses_rotation = options.senses_rotation;
  c.peak_force_n = 8.5;
  c.continuous_force_n = 1.4;
  c.position_resolution_m = options.position_step_m;
  c.apparent_mass_kg = options.device_mass_kg;
  c.largest_stiffness_n_per_m = 3500.0;
  c.largest_damping_n_s_per_m = 30.0;  // measured, tests/workbench/session/contact_instability_test.cpp
  c.workspace_half_size_m = Vec3(0.1905, 0.1335, 0.0955);
  c.rate_hz = 1000.0;
  return c;
}

Vec3 rounded(const Vec3& v, double step) {
  return step > 0.0 ? Vec3(std::round(v.x / step), std::round(v.y / step), std::round(v.z / step)) * step : v;
}

/// Uniform noise with zero mean and unit variance, computed from the generator's bits: standard distributions may
/// differ between libraries.
double uniform_noise(std::mt19937_64& random) {
  const double zero_to_one = static_cast<double>(random() >> 11) * 0x1p-53;
  return (2.0 * zero_to_one - 1.0) * std::numbers::sqrt3;
}

}  // namespace

SimulatedForceDevice::SimulatedForceDevice(const SimulatedForceOptions& options)
    : options_(options), capabilities_(describe(options)), life_(options.homing_s), random_(options.seed) {}

void SimulatedForceDevice::place(const HandTarget& target) noexcept {
  target_ = target;
  position_ = target.position_m;
  velocity_ = target.velocity_m_per_s;
}

// White noise n through a resonator a'' = -w^2 a - 2 z w a' + s n. With n of unit variance, held over a tick dt, its
// spectral density is dt and the stationary variance of a is s^2 dt / (4 z w^3), which we solve for s.
void SimulatedForceDevice::update_tremor(double dt_s) noexcept {
  if (options_.tremor_m <= 0.0) return;
  constexpr double w = 2.0 * std::numbers::pi * kTremorHz;
  const double drive = options_.tremor_m * std::sqrt(4.0 * kTremorDamping * w * w * w / dt_s);
  for (int axis = 0; axis < 3; ++axis) {
    const double push = drive * uniform_noise(random_);
    tremor_velocity_[axis] += dt_s * (push - w * w * tremor_[axis] - 2.0 * kTremorDamping * w * tremor_velocity_[axis]);
    tremor_[axis] += dt_s * tremor_velocity_[axis];
  }
}

// Semi-implicit Euler: new velocity first, then position with it, which keeps the energy of the spring bounded.
void SimulatedForceDevice::integrate(const Vec3& force, double dt_s) noexcept {
  const int substeps = std::max(1, options_.substeps);
  const double h = dt_s / substeps;
  const double mass = options_.device_mass_kg + options_.hand_mass_kg;
  for (int i = 0; i < substeps; ++i) {
    target_.position_m += h * target_.velocity_m_per_s;
    const Vec3 goal = target_.position_m + tremor_;
    const Vec3 pull = options_.hand_stiffness_n_per_m * (goal - position_) +
                      options_.hand_damping_n_s_per_m * (target_.velocity_m_per_s - velocity_);
    velocity_ += h / mass * (pull + force);
    // Dry friction only removes speed: it stops a slow mass and never pushes it back.
    const double speed = std::sqrt(glm::dot(velocity_, velocity_)), braked = h / mass * options_.friction_n;
    if (options_.friction_n > 0.0) velocity_ *= speed > braked ? (speed - braked) / speed : 0.0;
    position_ += h * velocity_;
  }
}

ForceSample SimulatedForceDevice::measure(const Vec3& force, double dt_s) noexcept {
  const bool lost = life_.fault() == DeviceFault::disconnected || life_.injected() == InjectedFault::delay_burst;
  age_s_ = lost ? age_s_ + dt_s : 0.0;
  if (!lost && life_.injected() != InjectedFault::stuck_encoder) shown_ = rounded(position_, options_.position_step_m);
  ForceSample sample;
  sample.position_m = shown_;
  if (life_.injected() == InjectedFault::noise) {
    for (int axis = 0; axis < 3; ++axis) sample.position_m[axis] += kNoise_m * uniform_noise(random_);
  }
  const bool moving = !lost && life_.injected() != InjectedFault::stuck_encoder;
  if (options_.measures_velocity && moving) sample.velocity_m_per_s = velocity_;
  sample.age_s = age_s_;
  sample.orientation = as_sensed(target_.orientation, capabilities_.senses_rotation);
  sample.force_n = force;
  sample.state = life_.state();
  sample.fault = life_.fault();
  return sample;
}

ForceSample SimulatedForceDevice::exchange(const ForceCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  life_.update(command.request, is_finite(command.force_n), dt_s);
  Vec3 force(0.0);
  if (life_.ready()) {
    force = command.force_n;
    // The motors saturate at their peak force.
    const double length = std::sqrt(glm::dot(force, force));
    if (length > capabilities_.peak_force_n) force *= capabilities_.peak_force_n / length;
  }
  update_tremor(dt_s);
  integrate(force, dt_s);
  return measure(force, dt_s);
}

}  // namespace tangent
