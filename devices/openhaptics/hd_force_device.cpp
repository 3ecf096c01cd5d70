#include "devices/openhaptics/hd_force_device.h"

#include "core/base/float_state.h"
#include "devices/openhaptics/hd_errors.h"

#include <cmath>

namespace tangent {

namespace {

constexpr auto kRelaxedHd = std::memory_order_relaxed;
constexpr int kCleanFrames = 3;  // without an error, before a reading is believed: the first ones are not of the device
constexpr int kMostErrors = 64;  // on the library's stack
constexpr double kBeyond_m = 20e-3;  // the largest workspace, before a position can't be one
constexpr double kFarthest_m = 2.0;  // no device of theirs is larger, where the library does not say

/// Worse than any other: it says that the device is gone.
bool is_worse(hd::ErrorCode code, hd::ErrorCode than) {
  return than == hd::kSuccess || hd::explain(code).fault == DeviceFault::disconnected;
}

bool all_finite(const double* values, int count) {
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

}  // namespace

// --- One frame, in the scheduler's thread --------------------------------------------------------------

hd::ErrorCode HdForceDevice::drain() noexcept {
  hd::ErrorCode worst = hd::kSuccess;
  for (int i = 0; i < kMostErrors; ++i) {
    const hd::ErrorCode code = api_.get_error().code;
    if (code == hd::kSuccess) break;
    errors_.fetch_add(1, kRelaxedHd);
    if (is_worse(code, worst)) worst = code;
  }
  return worst;
}

void HdForceDevice::note(hd::ErrorCode code) noexcept {
  if (code == hd::kSuccess) return;
  if (hd::is_frame_error(code) && clean_frames_ < kCleanFrames) {
    clean_frames_ = 0;  // the scheduler is starting
    return;
  }
  newest_error_.store(code, kRelaxedHd);
  const DeviceFault fault = hd::explain(code).fault;
  machine_.fail(fault);
  if (fault == DeviceFault::disconnected) lost_.store(true, kRelaxedHd);
}

void HdForceDevice::read(Reading& reading) noexcept {
  api_.get_doublev(hd::kPosition, reading.position_mm);
  api_.get_doublev(hd::kVelocity, reading.velocity_mm_per_s);
  api_.get_doublev(hd::kTransform, reading.transform);
  api_.get_integerv(hd::kButtons, &reading.buttons);
}

DeviceFault HdForceDevice::judge(const Reading& reading) const noexcept {
  if (!all_finite(reading.position_mm, 3) || !all_finite(reading.velocity_mm_per_s, 3)) return DeviceFault::sensor;
  if (capabilities_.rotations_sensed() > 0 && !hd::is_rotation(reading.transform)) return DeviceFault::sensor;
  const Vec3 reach = hd::half_size_m(reach_);
  const Vec3 off = hd::position_m(reading.position_mm, hd::centre_m(reach_));
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(off[axis]) > (reach[axis] > 0.0 ? reach[axis] + kBeyond_m : kFarthest_m)) return DeviceFault::sensor;
  return DeviceFault::none;
}

/// It calibrates itself where the hand has brought it to (its inkwell), which moves nothing.
void HdForceDevice::calibrate() noexcept {
  const hd::Enum needs = api_.check_calibration();
  needs_.store(needs, kRelaxedHd);
  if (needs == hd::kCalibrationNeedsUpdate && (style_ & (hd::kInkwell | hd::kAuto)) != 0)
    api_.update_calibration(style_);
  if (needs == hd::kCalibrationOk) machine_.enter(DeviceState::homing);
}

/// After a frame without an error.
void HdForceDevice::go_on() noexcept {
  switch (machine_.state()) {
    case DeviceState::absent:
      machine_.enter(DeviceState::open);
      clean_frames_ = 1;
      break;
    case DeviceState::open:
      if (++clean_frames_ >= kCleanFrames) machine_.enter(DeviceState::firmware);
      break;
    case DeviceState::firmware:
      calibrate();
      break;
    case DeviceState::homing:
      machine_.enter(DeviceState::ready);
      break;
    default:
      break;
  }
}

ForceSample HdForceDevice::frame(const ForceCommand& command) noexcept {
  ForceSample sample;
  Reading reading{};
  const bool was_faulted = machine_.state() == DeviceState::faulted;
  api_.begin_frame(device_);
  read(reading);
  hd::ErrorCode code = drain();
  note(code);
  if (clean_frames_ >= kCleanFrames && machine_.state() != DeviceState::faulted)
    if (const DeviceFault fault = judge(reading); fault != DeviceFault::none) machine_.fail(fault);
  if (machine_.ready() && !is_finite(command.force_n)) machine_.fail(DeviceFault::bad_command);
  if (machine_.ready() && !emergency_.load(kRelaxedHd)) sample.force_n = command.force_n;  // the keeper may be late
  const double force[3] = {sample.force_n.x, sample.force_n.y, sample.force_n.z};
  api_.set_doublev(hd::kForce, force);
  if (code == hd::kSuccess && !was_faulted) go_on();
  api_.end_frame(device_);
  note(code = drain());
  frames_.fetch_add(1, kRelaxedHd);
  const bool believed = clean_frames_ >= kCleanFrames && judge(reading) == DeviceFault::none;
  if (!believed) reading = {};
  if (believed) {
    sample.position_m = hd::position_m(reading.position_mm, centre_m_);
    sample.velocity_m_per_s = hd::velocity_m_per_s(reading.velocity_mm_per_s);
    if (capabilities_.rotations_sensed() > 0) sample.orientation = hd::orientation(reading.transform);
    sample.buttons = static_cast<std::uint32_t>(reading.buttons);
  } else {
    sample.position_m = newest_.position_m;
    sample.orientation = newest_.orientation;
  }
  return sample;
}

ForceSample HdForceDevice::exchange(const ForceCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  if (command.request == DeviceRequest::stop || command.request == DeviceRequest::clear_fault) {
    if (machine_.apply(command.request)) clean_frames_ = 0;
  }
  if (command.request == DeviceRequest::clear_fault) newest_error_.store(hd::kSuccess, kRelaxedHd);
  if (in_frame_call_) {
    newest_ = frame(command);
    fault_shown_ = false;
  } else {
    // No frame is possible: the scheduler is stopped.
    newest_.force_n = Vec3(0.0);
    newest_.velocity_m_per_s = std::nullopt;
    newest_.age_s += dt_s;
    if (!attached_.load(kRelaxedHd) && (machine_.state() != DeviceState::faulted || fault_shown_))
      machine_.enter(DeviceState::absent);
    fault_shown_ = true;
  }
  newest_.state = machine_.state();
  newest_.fault = machine_.fault();
  return newest_;
}

void HdForceDevice::zero_frame() noexcept {
  constexpr double kZero[3] = {0.0, 0.0, 0.0};
  api_.begin_frame(device_);
  api_.set_doublev(hd::kForce, kZero);
  api_.end_frame(device_);
  drain();
  last_frames_.fetch_add(1, std::memory_order_release);
}

}  // namespace tangent
