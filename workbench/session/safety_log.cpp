#include "workbench/session/safety_log.h"

namespace tangent {

void SafetyLog::add(SafetyEntry::Kind kind, const ServoRecord& record, std::string text) {
  if (entries_.size() == kMost) entries_.pop_front();
  entries_.push_back({kind, record.tick.tick, record.tick.input.t_s, std::move(text)});
}

/// That arming waits, and why, and that it was given up.
void SafetyLog::watch_arming(const ServoRecord& record) {
  const DeviceTelemetry& now = record.device;
  if (now.arming == last_.arming && now.in_the_way == last_.in_the_way) return;
  if (now.arming == ArmingStage::arming && now.in_the_way != ArmingObstacle::none)
    add(SafetyEntry::Kind::state, record, std::string("arming waits: ") + to_string(now.in_the_way));
  if (now.arming == ArmingStage::given_up && last_.arming != ArmingStage::given_up)
    add(SafetyEntry::Kind::fault, record, std::string("arming given up: ") + to_string(now.in_the_way));
}

void SafetyLog::watch(const ServoRecord& record) {
  using Kind = SafetyEntry::Kind;
  const DeviceTelemetry& now = record.device;
  const auto device = [&](const char* name, DeviceState before, DeviceState state, DeviceFault fault) {
    if (state == before) return;
    if (state == DeviceState::faulted)
      add(Kind::fault, record, std::string(name) + ": " + to_string(fault));
    else
      add(Kind::state, record, std::string(name) + ": " + to_string(state));
  };
  device("force device", last_.force_state, now.force_state, now.force_fault);
  device("contact display", last_.display_state, now.display_state, now.display_fault);
  if (now.gate_state != last_.gate_state) {
    if (now.gate_state == GateState::faulted)
      add(Kind::fault, record, std::string("safety gate: ") + to_string(now.gate_fault));
    else
      add(Kind::state, record, std::string("safety gate: ") + to_string(now.gate_state));
  }
  watch_arming(record);
  for (std::size_t i = 0; i < kGateActionCount; ++i) {
    const auto action = static_cast<GateAction>(i);
    if (((now.gate_actions >> i) & 1u) == 0) continue;
    const bool known = last_action_tick_[i] > 0 && record.tick.tick + 1 - last_action_tick_[i] <= kQuietTicks;
    last_action_tick_[i] = record.tick.tick + 1;
    // These follow from arming and stopping, which are logged already.
    if (!known && action != GateAction::ramped_in && action != GateAction::withheld)
      add(Kind::action, record, to_string(action));
  }
  last_ = now;
}

}  // namespace tangent
