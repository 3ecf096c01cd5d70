// Whether what a firmware says can be true, and when its sample was measured. Pure: no clock, no allocation.
#pragma once

#include "devices/serial/serial_messages.h"

#include "core/base/vec.h"

#include <cstdint>

namespace tangent {

/// Why the line's force device is not believed, or does not answer as one.
enum class SerialTrouble : std::uint8_t {
  none,
  not_measured,  ///< no number in place of a coordinate
  outside,       ///< farther out than twice its workspace
  not_unit,      ///< an orientation that is no unit quaternion
  time_stood,    ///< two samples of the same time
  time_backwards,
  time_ahead,    ///< a sample that was measured after it came
  time_slow,     ///< its clock is slow by more than 500 ppm, or every sample of a second waited
  flood,         ///< far more bytes than its telemetry makes
  deaf,          ///< takes no commands, or does not hear them
  silent,        ///< no sample for too long
  no_answer,     ///< not one force message
  display,       ///< answers as a display without force messages
  version,       ///< of the force messages
  unfit,         ///< a watchdog or rate that the protocol does not allow
  other_device,  ///< is not the one that was opened
};

/// "its clock ran backwards".
const char* to_string(SerialTrouble trouble);

/// When samples were measured, on the host's clock, by the device's own time stamps: their delay varies, the smallest
/// one is taken for none. So a sample that waited on its way is as old as it is; what every sample waits at least
/// remains unknown. The two clocks may differ by 500 ppm; where the device's is slower, samples would seem older and
/// older, and that is said.
class SampleClock {
 public:
  static constexpr std::int64_t kWindow_ns = 1'000'000'000;  ///< of the device's clock
  static constexpr std::int64_t kSlow_ns = 1'000'000;        ///< that every sample of a window was late

  /// none, time_stood, time_backwards, time_ahead or time_slow. `arrived_ns`: on the host's clock.
  SerialTrouble add(std::uint32_t time_us, std::int64_t arrived_ns) noexcept;
  std::int64_t measured_ns() const noexcept { return device_ns_ + offset_ns_; }
  void restart() noexcept { *this = {}; }

 private:
  bool is_slow(std::int64_t late_ns, std::int64_t moved_ns) noexcept;

  bool known_ = false;
  std::uint32_t last_us_ = 0;
  std::int64_t device_ns_ = 0;                                  ///< its clock, unwrapped
  std::int64_t offset_ns_ = 0;                                  ///< host's clock less the device's, smallest seen
  std::int64_t in_window_ns_ = 0, least_late_ns_ = kWindow_ns;  ///< of the samples since the window began
};

/// In SI units, in the device's frame.
struct SerialSample {
  Vec3 position_m{0.0};
  Quat orientation{1.0, 0.0, 0.0, 0.0};
  Vec3 force_n{0.0};
};

/// Coordinates along axes that the device lacks are 0, whatever it says: those it neither pushes along nor gives a
/// workspace for.
SerialTrouble read_sample(const ForceTelemetry& telemetry, const ForceInfo& info, SerialSample& out) noexcept;

}  // namespace tangent
