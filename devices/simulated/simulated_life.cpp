#include "devices/simulated/simulated_life.h"

namespace tangent {

Status SimulatedLife::open(const std::string& name) {
  if (machine_.state() != DeviceState::absent) return fail("is already open", name, "close it first");
  machine_.enter(DeviceState::open);
  return {};
}

void SimulatedLife::update(DeviceRequest request, bool finite, double dt_s) noexcept {
  injected_ = timer_.next();
  if (injected_ == InjectedFault::drop_out) machine_.fail(DeviceFault::disconnected);
  if (next_fault_ != DeviceFault::none) {
    machine_.fail(next_fault_);
    next_fault_ = DeviceFault::none;
  }
  if (machine_.state() == DeviceState::open) machine_.enter(DeviceState::firmware);  // identifies itself at once
  if (machine_.state() == DeviceState::homing) {
    homing_for_s_ += dt_s;
    if (homing_for_s_ >= homing_s_) machine_.enter(DeviceState::ready);
  }
  const bool answers = injected_ != InjectedFault::drop_out;
  if (answers && machine_.apply(request) && machine_.state() == DeviceState::homing) homing_for_s_ = 0.0;
  if (machine_.ready() && !finite) machine_.fail(DeviceFault::bad_command);
}

}  // namespace tangent
