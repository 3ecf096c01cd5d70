// The servo's half of the Falcon's driver: ticks of the encoders to a position, a force to torque counts, and the
// state. No USB and no clock: they are given (falcon_device.h), so that tests can step it.
//
// absent -> open (asking, uploading) -> firmware -> homing (a person pulls the grip all the way out and pushes it in;
// the device says for each leg when it has found its zero) -> ready. Nobody has to ask for homing: nothing moves by
// itself. Until homed there is no force.
#pragma once

#include "devices/falcon/falcon_kinematics.h"
#include "devices/falcon/falcon_line.h"
#include "devices/falcon/falcon_options.h"
#include "devices/force_device.h"

namespace tangent {

inline constexpr double kFalconPeak_n = 8.9;              ///< advertised ("> 8.9 N"), when calibrated
inline constexpr double kFalconUncalibratedPeak_n = 1.0;  ///< by our choice
inline constexpr int kFalconMostCounts = 4095;            ///< as an early public driver; a number wraps at 32,767
inline constexpr int kFalconUncalibratedCounts = 1023;    ///< by our choice

/// What it can do; unknown is 0. Calibrated, as far as this says, where what is given or kept may be: of the one that
/// is plugged in later the driver knows.
ForceCapabilities falcon_capabilities(const FalconOptions& options);

/// Counts that push with this force (device's axes, from the middle of the workspace). Above `most` all three shrink
/// alike, so that the direction stays. Zero where the mechanism is singular or the force not finite.
std::array<std::int16_t, 3> falcon_counts(const Vec3& position_m, const Vec3& force_n, double counts_per_nm, int most,
                                          double& share) noexcept;

class FalconDriver {
 public:
  using Firmwares = std::map<std::string, std::vector<std::uint8_t>>;

  /// `firmware`: given, for any; empty: none. `kept`: of Falcons by serial number, for where none is given.
  FalconDriver(const FalconOptions& options, std::vector<std::uint8_t> firmware, Firmwares kept = {});

  FalconLine& line() { return line_; }
  const FalconLine& line() const { return line_; }
  const ForceCapabilities& capabilities() const { return capabilities_; }

  /// Link's thread: a device is there. Its torque scale and firmware are those that were given, or are kept for it.
  void opened(const std::string& serial, std::int64_t now_ns) noexcept;
  /// Any thread: the torque scale of the one that is there was measured.
  bool calibrated() const noexcept { return scale_.load(std::memory_order_relaxed) > 0.0; }

  /// Servo's thread. The clock is read once, after the newest answer was taken: none is from the future.
  ForceSample exchange(const ForceCommand& command, std::int64_t (*now_ns)() noexcept) noexcept;
  /// The same at a time that is given, where nobody else makes answers meanwhile.
  ForceSample exchange(const ForceCommand& command, std::int64_t now_ns) noexcept;
  /// Any thread: no torque, and faulted until a person clears it.
  void stop() noexcept;
  int legs_homed() const noexcept { return legs_homed_.load(std::memory_order_relaxed); }  ///< any thread

 private:
  void listen() noexcept;
  ForceSample respond(const ForceCommand& command, std::int64_t now_ns) noexcept;
  void follow_connection() noexcept;
  void measure() noexcept;
  void watch(const ForceCommand& command, std::int64_t now_ns) noexcept;
  void carry_out(DeviceRequest request) noexcept;
  FalconCommand command_for(const Vec3& force_n, double& share) const noexcept;

  const FalconOptions options_;
  const Firmwares kept_;
  const ForceCapabilities capabilities_;
  FalconLine line_;
  std::atomic<bool> was_stopped_{false};
  std::atomic<int> legs_homed_{0};
  std::atomic<double> scale_;  ///< counts for 1 N m of the newest connection, set before it begins; 0: not calibrated

  // Servo's thread.
  DeviceStateMachine machine_;
  FalconHeard newest_;
  bool heard_ = false;           ///< in this connection
  bool homing_wanted_ = false;   ///< the device is told to keep its zero
  bool position_known_ = false;  ///< the newest encoders are a place
  std::uint32_t seen_connection_ = 0;
  double counts_per_nm_ = 0.0;  ///< of that connection; 0: not calibrated
  std::int64_t last_ns_ = 0;
  Vec3 place_m_ = kFalconCentre_m;  ///< the newest, in the mechanism's axes
};

}  // namespace tangent
