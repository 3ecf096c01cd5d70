#include "workbench/experiment/simulated_touch.h"

namespace tangent::experiment {
namespace {

SimulatedForceOptions with_seed(std::uint64_t seed) {
  SimulatedForceOptions out;
  out.seed = seed;
  return out;
}

}  // namespace

SimulatedTouch::SimulatedTouch(std::shared_ptr<const ContactScene> scene, const Preset& preset, std::uint64_t seed,
                               const Quat& turn)
    : preset_(preset), stepper_(std::move(scene)), device_(with_seed(seed)), turn_(turn) {}

Status SimulatedTouch::begin(const HandTarget& at) {
  if (Status ok = device_.open(); !ok) return ok;
  device_.lead(at);
  device_.place(at);
  device_.exchange({.request = DeviceRequest::home}, kTouchTick_s);
  for (int i = 0; i < 1000 && device_.exchange({}, kTouchTick_s).state != DeviceState::ready; ++i) device_.place(at);
  return {};
}

TickOutput SimulatedTouch::tick(const HandTarget& target) {
  device_.lead(target);
  const ForceSample sample = device_.exchange({.force_n = force_n_}, kTouchTick_s);
  const TickOutput out = stepper_.step(preset_, {t_s_, {sample.position_m, turn_ * sample.orientation}}, state_);
  t_s_ += kTouchTick_s;
  force_n_ = out.force_n;
  return out;
}

}  // namespace tangent::experiment
