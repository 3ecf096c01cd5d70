#include "devices/serial/sample_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {

namespace {

constexpr std::int64_t kAhead_ns = 50'000'000;  // more than clocks and buffers explain
constexpr std::int64_t kDrift = 2000;           // 500 ppm: crystals have 100
constexpr double kOutside = 2.0;                // workspaces: beyond one the gate fades the force out
constexpr double kUnit = 0.02;                  // of a quaternion's square; rounding makes 0.0001

}  // namespace

const char* to_string(SerialTrouble trouble) {
  switch (trouble) {
    case SerialTrouble::none:
      return "";
    case SerialTrouble::not_measured:
      return "it measured no position";
    case SerialTrouble::outside:
      return "a position was far outside its workspace";
    case SerialTrouble::not_unit:
      return "an orientation was no rotation";
    case SerialTrouble::time_stood:
      return "its clock stood still";
    case SerialTrouble::time_backwards:
      return "its clock ran backwards: it was reset, perhaps";
    case SerialTrouble::time_ahead:
      return "its clock leapt ahead";
    case SerialTrouble::time_slow:
      return "its clock is slow by more than 500 ppm (no crystal?), or its positions wait on the line";
    case SerialTrouble::flood:
      return "it floods the line";
    case SerialTrouble::deaf:
      return "it does not hear commands";
    case SerialTrouble::silent:
      return "it fell silent";
    case SerialTrouble::no_answer:
      return "nothing on this port answers as a force device";
    case SerialTrouble::display:
      return "its firmware knows no force messages: it is a display";
    case SerialTrouble::version:
      return "its firmware speaks another version of the force messages";
    case SerialTrouble::unfit:
      return "its firmware states a watchdog or a rate that is not allowed (10 to 200 ms, 100 Hz or more)";
    case SerialTrouble::other_device:
      return "it is not the device that was opened";
  }
  return "?";
}

SerialTrouble SampleClock::add(std::uint32_t time_us, std::int64_t arrived_ns) noexcept {
  if (!known_) {
    *this = {};
    known_ = true;
    last_us_ = time_us;
    offset_ns_ = arrived_ns;
    return SerialTrouble::none;
  }
  const auto ahead_us = static_cast<std::int32_t>(time_us - last_us_);
  if (ahead_us == 0) return SerialTrouble::time_stood;
  if (ahead_us < 0) return SerialTrouble::time_backwards;
  last_us_ = time_us;
  const std::int64_t moved_ns = std::int64_t{ahead_us} * 1000;
  device_ns_ += moved_ns;
  const std::int64_t offset_ns = arrived_ns - device_ns_;
  if (offset_ns < offset_ns_ - kAhead_ns) return SerialTrouble::time_ahead;
  offset_ns_ = std::min(offset_ns_ + moved_ns / kDrift, offset_ns);
  return is_slow(offset_ns - offset_ns_, moved_ns) ? SerialTrouble::time_slow : SerialTrouble::none;
}

bool SampleClock::is_slow(std::int64_t late_ns, std::int64_t moved_ns) noexcept {
  least_late_ns_ = std::min(least_late_ns_, late_ns);
  in_window_ns_ += moved_ns;
  if (in_window_ns_ < kWindow_ns) return false;
  in_window_ns_ = 0;
  return std::exchange(least_late_ns_, kWindow_ns) > kSlow_ns;
}

SerialTrouble read_sample(const ForceTelemetry& t, const ForceInfo& info, SerialSample& out) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const bool has = ((info.pushes_along >> i) & 1u) != 0 || info.workspace_um[i] > 0;
    if (has && t.position_nm[i] == kNotMeasured) return SerialTrouble::not_measured;
    out.position_m[axis] = has ? 1e-9 * t.position_nm[i] : 0.0;
    out.force_n[axis] = 1e-3 * t.force_mn[i];
    const double half_m = 1e-6 * info.workspace_um[i];
    if (half_m > 0.0 && std::abs(out.position_m[axis]) > kOutside * half_m) return SerialTrouble::outside;
  }
  if (info.senses_rotation == 0) return SerialTrouble::none;
  const Quat q(t.orientation[0] * kQuaternionUnit, t.orientation[1] * kQuaternionUnit,
               t.orientation[2] * kQuaternionUnit, t.orientation[3] * kQuaternionUnit);
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (std::abs(square - 1.0) > kUnit) return SerialTrouble::not_unit;
  out.orientation = q * (1.0 / std::sqrt(square));
  return SerialTrouble::none;
}

}  // namespace tangent
