// What a plug-in answers, believed only where it can be: numbers that are finite, a place that the device can reach, a
// clock that doesn't run backwards, an answer in time. Plain state and arithmetic: no clock, no allocation, no lock;
// servo thread. Device frame, SI.
//
//   garbage   not finite, outside, time backwards, no such state: fault, latched until a person clears it
//   silence   two ticks without a new measurement: no force is sent, and the sample's age grows, which the gate stops
//             at 10 ms; one that comes back before gets its force faded in again
//   lost      its process is gone, or its exchange failed, hung or allocated: fault, latched
#pragma once

#include "devices/force_device.h"
#include "devices/plugin/plugin_line.h"

#include <array>
#include <cstdint>

namespace tangent {

/// What is wrong with a sample.
enum class PluginGarbage : std::uint8_t { none, not_finite, outside, backwards, words };
const char* to_string(PluginGarbage garbage);

class PluginJudge {
 public:
  static constexpr double kFadeIn_s = 0.05;  ///< of the force, after silence

  explicit PluginJudge(const ForceCapabilities& can) : can_(can) {}

  /// Before command `number` (one more than the last) is sent, dt_s after the last: the force that may go with it.
  Vec3 begin(const Vec3& force_n, std::uint64_t number, double dt_s) noexcept;
  /// After it.
  ForceSample end(const PluginTurn& turn, const ForceCommand& command) noexcept;

  std::uint32_t connection() const { return connection_; }  ///< that it judges
  bool withholds() const { return share_ == 0.0; }
  PluginGarbage garbage() const { return garbage_; }  ///< the newest; none: cleared
  PluginVerdict verdict() const { return verdict_; }  ///< the newest that made a fault

 private:
  void connect(const PluginTurn& turn) noexcept;
  void hear(const PluginAnswer& answer) noexcept;
  void take(const PluginAnswer& answer) noexcept;
  PluginGarbage look(const PluginAnswer& answer) const noexcept;
  bool can_be_at(const double (&position_m)[3]) const noexcept;
  void latch(DeviceFault fault) noexcept;

  static constexpr std::uint64_t kRemembered = 64;  ///< commands
  ForceCapabilities can_;
  ForceSample newest_;
  DeviceFault fault_ = DeviceFault::none;
  PluginGarbage garbage_ = PluginGarbage::none;
  PluginVerdict verdict_ = PluginVerdict::none;
  bool connected_ = false, heard_ = false;
  std::uint32_t connection_ = 0;
  std::uint64_t number_ = 0, first_number_ = 1, believed_from_ = 0;
  double now_s_ = 0.0;       ///< sum of dt_s
  double measured_s_ = 0.0;  ///< when newest_ was
  double since_new_s_ = 0.0;
  double plugin_time_s_ = 0.0;
  double share_ = 1.0;
  std::array<double, kRemembered> sent_s_{};
};

}  // namespace tangent
