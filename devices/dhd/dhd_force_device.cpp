#include "devices/dhd/dhd_force_device.h"

#include "core/base/float_state.h"
#include "devices/dhd/dhd_errors.h"
#include "devices/dhd/dhd_models.h"

#include <cmath>
#include <utility>

namespace tangent {

namespace {

constexpr auto kRelaxedDhd = std::memory_order_relaxed;
constexpr double kStale_s = 2.5e-3;  // two ticks without a new position: no force
constexpr int kForceComesOn = 20;    // exchanges until the status says that the motors are on
constexpr double kFarthest_m = 1.0;  // no device of theirs is larger

bool three_finite(const double values[3]) {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

}  // namespace

// --- One exchange, in the servo's thread ---------------------------------------------------------------

void DhdForceDevice::fail_by(int code) noexcept {
  newest_error_.store(code, kRelaxedDhd);
  const DeviceFault fault = dhd::explain(code).fault;
  if (fault == DeviceFault::none) return;
  machine_.fail(fault);
  lost_ = lost_ || fault == DeviceFault::disconnected;
}

void DhdForceDevice::forget_errors() noexcept {
  newest_error_.store(0, kRelaxedDhd);
  force_off_cause_.store(-1, kRelaxedDhd);
}

/// Whether a call was answered; else its error is noted.
bool DhdForceDevice::called(int returned) noexcept {
  if (returned >= 0) return true;
  errors_.fetch_add(1, kRelaxedDhd);
  const int code = api_.error_get_last();
  fail_by(code == 0 ? 1 : code);
  return false;
}

bool DhdForceDevice::read(Reading& r, double dt_s) noexcept {
  const char id = id_.load(kRelaxedDhd);
  if (!called(api_.get_status(r.status, id))) return false;
  const int position = api_.get_position(&r.position_m[0], &r.position_m[1], &r.position_m[2], id);
  if (!called(position)) return false;
  newest_.age_s = position == dhd::kTimeGuard ? newest_.age_s + dt_s : 0.0;
  if (!called(api_.get_linear_velocity(&r.velocity_m_per_s[0], &r.velocity_m_per_s[1], &r.velocity_m_per_s[2], id)))
    return false;
  if (capabilities_.rotations_sensed() > 0 && !called(api_.get_orientation_frame(r.matrix, id))) return false;
  r.buttons = api_.get_button_mask(id);
  return true;
}

DeviceFault DhdForceDevice::judge(const Reading& r) const noexcept {
  if (r.status[dhd::kStatusConnected] == 0 || r.status[dhd::kStatusPower] == 0) return DeviceFault::disconnected;
  if (r.status[dhd::kStatusError] != 0) return DeviceFault::actuator;
  if (!three_finite(r.position_m) || !three_finite(r.velocity_m_per_s)) return DeviceFault::sensor;
  if (capabilities_.rotations_sensed() > 0 && !dhd::is_rotation(r.matrix)) return DeviceFault::sensor;
  const double farthest_m = reach_m_ > 0.0 ? reach_m_ : kFarthest_m;
  for (const double coordinate : r.position_m)
    if (std::abs(coordinate) > farthest_m) return DeviceFault::sensor;
  return DeviceFault::none;
}

/// While it is ready its motors are on; it says itself why they are not.
void DhdForceDevice::check_force_is_on(const Reading& r) noexcept {
  if (!machine_.ready()) return;
  if (r.status[dhd::kStatusReset] == 0) {
    machine_.fail(DeviceFault::sensor);
    return;
  }
  if (r.status[dhd::kStatusForce] != 0) {
    since_force_on_ = kForceComesOn;
    return;
  }
  if (since_force_on_++ < kForceComesOn) return;
  const int cause = r.status[dhd::kStatusForceOffCause];
  force_off_cause_.store(cause, kRelaxedDhd);
  machine_.fail(dhd::explain_force_off(cause).fault);
}

void DhdForceDevice::go_on(const Reading& r) noexcept {
  const bool calibrated = r.status[dhd::kStatusReset] != 0;
  calibrated_.store(calibrated, kRelaxedDhd);
  switch (machine_.state()) {
    case DeviceState::absent:
      machine_.enter(DeviceState::open);
      break;
    case DeviceState::open:
      machine_.enter(DeviceState::firmware);
      break;
    case DeviceState::firmware:
      if (calibrated) machine_.enter(DeviceState::homing);
      break;
    case DeviceState::homing:
      since_force_on_ = 0;
      if (called(api_.enable_force(dhd::kOn, id_.load(kRelaxedDhd)))) machine_.enter(DeviceState::ready);
      break;
    default:
      break;
  }
}

void DhdForceDevice::send(const Vec3& f) noexcept {
  newest_.force_n = f;
  called(api_.set_force(f.x, f.y, f.z, 0.0, 0.0, 0.0, 0.0, id_.load(kRelaxedDhd)));
}

/// First that it is lost, then that it is absent.
ForceSample DhdForceDevice::away(double dt_s) noexcept {
  if (machine_.state() != DeviceState::faulted || fault_shown_) machine_.enter(DeviceState::absent);
  fault_shown_ = true;
  newest_.force_n = Vec3(0.0);
  newest_.velocity_m_per_s = std::nullopt;
  newest_.age_s += dt_s;
  newest_.state = machine_.state();
  newest_.fault = machine_.fault();
  return newest_;
}

ForceSample DhdForceDevice::exchange(const ForceCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  if (phase_.load(std::memory_order_acquire) != Phase::attached) return away(dt_s);
  if (command.request == DeviceRequest::stop || command.request == DeviceRequest::clear_fault)
    machine_.apply(command.request);
  if (command.request == DeviceRequest::clear_fault) forget_errors();
  Reading r{};
  newest_.velocity_m_per_s = std::nullopt;
  const bool was_faulted = machine_.state() == DeviceState::faulted;
  const bool answered = read(r, dt_s);
  const DeviceFault wrong = answered ? judge(r) : DeviceFault::none;
  if (wrong == DeviceFault::disconnected) fail_by(2);  // DHD_ERROR_COM
  if (wrong != DeviceFault::none) machine_.fail(wrong);
  check_force_is_on(r);
  if (machine_.ready() && !is_finite(command.force_n)) machine_.fail(DeviceFault::bad_command);
  const bool fresh = newest_.age_s <= kStale_s && !emergency_.load(kRelaxedDhd);
  send(machine_.ready() && fresh ? command.force_n : Vec3(0.0));
  if (answered && wrong == DeviceFault::none) {
    newest_.position_m = Vec3(r.position_m[0], r.position_m[1], r.position_m[2]);
    newest_.velocity_m_per_s = Vec3(r.velocity_m_per_s[0], r.velocity_m_per_s[1], r.velocity_m_per_s[2]);
    if (capabilities_.rotations_sensed() > 0) newest_.orientation = dhd::orientation(r.matrix);
    newest_.buttons = r.buttons;
    if (!was_faulted) go_on(r);
  }
  fault_shown_ = machine_.state() == DeviceState::faulted;
  frames_.fetch_add(1, kRelaxedDhd);
  newest_.state = machine_.state();
  newest_.fault = machine_.fault();
  // Only now, as from then on the keeper has the device.
  if (std::exchange(lost_, false)) phase_.store(Phase::lost, std::memory_order_release);
  return newest_;
}

}  // namespace tangent
