#include "devices/plugin/plugin_judge.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

bool all_finite(const double (&values)[3]) noexcept {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

Vec3 vector_of(const double (&values)[3]) noexcept { return {values[0], values[1], values[2]}; }

DeviceFault fault_of(PluginVerdict verdict) noexcept {
  switch (verdict) {
    case PluginVerdict::none:
      return DeviceFault::none;
    case PluginVerdict::allocated:
      return DeviceFault::firmware;
    case PluginVerdict::silent:
    case PluginVerdict::stopped:
      return DeviceFault::watchdog;
    case PluginVerdict::failed:
    case PluginVerdict::hung:
      return DeviceFault::disconnected;
  }
  return DeviceFault::firmware;
}

}  // namespace

const char* to_string(PluginGarbage garbage) {
  switch (garbage) {
    case PluginGarbage::none:
      return "";
    case PluginGarbage::not_finite:
      return "a sample of the plug-in is not finite";
    case PluginGarbage::outside:
      return "a position of the plug-in is far outside the device's workspace";
    case PluginGarbage::backwards:
      return "the plug-in's time runs backwards";
    case PluginGarbage::words:
      return "a sample of the plug-in has a state, a rotation or an age that can't be";
  }
  return "?";
}

void PluginJudge::latch(DeviceFault fault) noexcept {
  if (fault_ == DeviceFault::none) fault_ = fault;
}

Vec3 PluginJudge::begin(const Vec3& force_n, std::uint64_t number, double dt_s) noexcept {
  constexpr double kUsualPeriod_s = 1e-3;
  const double between_s = can_.rate_hz > 0.0 ? 1.0 / can_.rate_hz : kUsualPeriod_s;
  // At the first tick without one the force is that of the last; at the second there is none.
  const bool silent = since_new_s_ > 1.5 * std::max(dt_s, between_s);
  share_ = silent ? 0.0 : std::min(1.0, share_ + dt_s / kFadeIn_s);
  now_s_ += dt_s;
  since_new_s_ += dt_s;
  number_ = number;
  sent_s_[number % kRemembered] = now_s_;
  const bool may = fault_ == DeviceFault::none && connected_ && heard_ && newest_.state == DeviceState::ready;
  return may ? share_ * force_n : Vec3(0.0);
}

void PluginJudge::connect(const PluginTurn& turn) noexcept {
  if (!turn.connected) {
    if (connected_) latch(DeviceFault::disconnected);
    connected_ = heard_ = false;
    return;
  }
  if (connected_ && turn.connection == connection_) return;
  if (connected_) latch(DeviceFault::disconnected);  // it was another one within a tick
  connected_ = true;
  connection_ = turn.connection;
  heard_ = false;
  first_number_ = number_;
  since_new_s_ = 0.0;
  share_ = 1.0;
}

// A device's box lies within what it reaches, and the gate fades the force out at its walls. What is far out is a lie.
bool PluginJudge::can_be_at(const double (&position_m)[3]) const noexcept {
  constexpr double kBeyond = 1.5, kMargin_m = 0.02, kFarthest_m = 2.0;
  bool can = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = can_.workspace_half_size_m[axis];
    can = can && std::abs(position_m[axis]) <= (half > 0.0 ? kBeyond * half + kMargin_m : kFarthest_m);
  }
  return can;
}

PluginGarbage PluginJudge::look(const PluginAnswer& answer) const noexcept {
  const tangent_device_sample& s = answer.sample;
  const bool finite = all_finite(s.position_m) && std::isfinite(s.time_s) && std::isfinite(s.age_s) &&
                      all_finite(s.force_n) && (s.has_velocity == 0 || all_finite(s.velocity_m_per_s)) &&
                      (can_.rotations_sensed() == 0 ||
                       std::isfinite(s.orientation[0] + s.orientation[1] + s.orientation[2] + s.orientation[3]));
  if (!finite) return PluginGarbage::not_finite;
  const double* q = s.orientation;
  constexpr double kUnit = 1e-3, kOldest_s = 3600.0;
  const bool unit =
      can_.rotations_sensed() == 0 || std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) <= kUnit;
  if (!unit || s.age_s < 0.0 || s.age_s > kOldest_s || s.state > TANGENT_DEVICE_FAULTED ||
      s.fault > TANGENT_DEVICE_WATCHDOG || answer.number > number_)
    return PluginGarbage::words;
  if (heard_ && s.time_s < plugin_time_s_) return PluginGarbage::backwards;
  if (s.state == TANGENT_DEVICE_READY && !can_be_at(s.position_m)) return PluginGarbage::outside;
  return PluginGarbage::none;
}

void PluginJudge::take(const PluginAnswer& answer) noexcept {
  const tangent_device_sample& s = answer.sample;
  const bool is_new = !heard_ || s.time_s > plugin_time_s_;
  newest_.state = static_cast<DeviceState>(s.state);
  newest_.fault = newest_.state == DeviceState::faulted ? static_cast<DeviceFault>(s.fault) : DeviceFault::none;
  newest_.buttons = can_.buttons >= 32 ? s.buttons : s.buttons & ((1u << can_.buttons) - 1u);
  newest_.force_n = vector_of(s.force_n);
  heard_ = true;
  plugin_time_s_ = s.time_s;
  if (!is_new) return;
  const double sent_s = number_ - answer.number < kRemembered ? sent_s_[answer.number % kRemembered] : 0.0;
  measured_s_ = sent_s - s.age_s;
  since_new_s_ = now_s_ - sent_s;
  newest_.position_m = vector_of(s.position_m);
  newest_.velocity_m_per_s.reset();
  if (s.has_velocity != 0) newest_.velocity_m_per_s = vector_of(s.velocity_m_per_s);
  if (can_.rotations_sensed() == 0) return;
  newest_.orientation = glm::normalize(Quat(s.orientation[0], s.orientation[1], s.orientation[2], s.orientation[3]));
}

void PluginJudge::hear(const PluginAnswer& answer) noexcept {
  // An answer to a command from before a person cleared the fault says what was cleared.
  if (answer.number < first_number_ || answer.number < believed_from_) return;
  if (answer.verdict != PluginVerdict::none) {
    verdict_ = answer.verdict;
    return latch(fault_of(answer.verdict));
  }
  const PluginGarbage garbage = look(answer);
  if (garbage == PluginGarbage::none) return take(answer);
  garbage_ = garbage;
  latch(garbage == PluginGarbage::words ? DeviceFault::firmware : DeviceFault::sensor);
}

ForceSample PluginJudge::end(const PluginTurn& turn, const ForceCommand& command) noexcept {
  connect(turn);
  // Nothing is cleared while nobody is there to be told.
  if (command.request == DeviceRequest::clear_fault && connected_) {
    fault_ = DeviceFault::none;
    garbage_ = PluginGarbage::none;
    verdict_ = PluginVerdict::none;
    believed_from_ = number_;
    heard_ = false;  // its clock may have begun anew
  }
  if (connected_ && turn.answered) hear(turn.answer);
  ForceSample sample = newest_;
  sample.age_s = std::max(0.0, now_s_ - measured_s_);
  if (fault_ != DeviceFault::none) {
    sample.state = DeviceState::faulted;
    sample.fault = fault_;
  } else if (!heard_) {
    sample.state = connected_ ? DeviceState::open : DeviceState::absent;
    sample.fault = DeviceFault::none;
  }
  if (sample.state != DeviceState::ready) sample.force_n = Vec3(0.0);
  return sample;
}

}  // namespace tangent
