// A Force Dimension delta, omega, sigma or lambda through the maker's SDK (DHD). Our clock calls it.
//
//   servo's thread                              keeper's thread
//   exchange: status, position, velocity,       stops and closes a lost device and looks for it again; stops the force
//   orientation, buttons, then the force        in an emergency, while an exchange does not return
// The SDK is safe to call from several threads (its reference, "Threading"). While the keeper has the device, an
// exchange does not touch the library.
//
// It is calibrated by hand: the handle at its rest position until the device's light stops blinking; it keeps that
// until it is switched off. dhdReset and drdAutoInit, which would ask for it anew or move the arms, are never called.
#pragma once

#include "devices/dhd/dhd_api.h"
#include "devices/force_device.h"
#include "devices/vendor_options.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace tangent {

class DhdForceDevice final : public ForceDevice {
 public:
  explicit DhdForceDevice(const DhdOptions& options = {});
  ~DhdForceDevice() override { close(); }

  /// Constant from open on: only the open device says what it is.
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  /// Loads the library, once, and opens the device. Fails without library, device or permission, when the SDK is too
  /// old, and when several are attached and none was chosen (they are listed).
  Status open() override;
  /// Zero force, force off and brakes on, the device closed: in this order.
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  /// The keeper calls dhdStop.
  bool emergency_stop() noexcept override;
  /// What it is, and the newest error in words.
  bool report(LinkReport& out) const override;

 private:
  struct Reading {
    double position_m[3], velocity_m_per_s[3], matrix[3][3];
    int status[dhd::kStatusRoom];
    unsigned buttons;
  };
  enum class Phase : std::uint8_t { closed, attached, lost, away };

  // Owner's or keeper's thread.
  Result<int> attach();
  Status learn(int id);
  void keep() noexcept;
  void let_go() noexcept;
  void look_again() noexcept;

  // Servo's thread.
  bool called(int returned) noexcept;
  bool read(Reading& reading, double dt_s) noexcept;
  DeviceFault judge(const Reading& reading) const noexcept;
  void check_force_is_on(const Reading& reading) noexcept;
  void fail_by(int code) noexcept;
  void forget_errors() noexcept;
  void go_on(const Reading& reading) noexcept;
  void send(const Vec3& force_n) noexcept;
  ForceSample away(double dt_s) noexcept;

  DhdOptions options_;
  ForceCapabilities capabilities_;
  std::string identity_;
  dhd::Api api_{};
  double reach_m_ = 0.0;  ///< 0: not known
  bool loaded_ = false;
  std::thread keeper_;
  std::int64_t next_try_ns_ = 0;

  // Servo's thread.
  DeviceStateMachine machine_;
  ForceSample newest_;
  int since_force_on_ = 0;
  bool fault_shown_ = false, lost_ = false;

  // Between threads.
  std::atomic<Phase> phase_{Phase::closed};
  std::atomic<char> id_{-1};
  std::atomic<bool> keeper_ends_{false}, emergency_{false};
  std::atomic<int> newest_error_{0}, force_off_cause_{-1};
  std::atomic<bool> calibrated_{true};
  std::atomic<std::uint64_t> frames_{0}, errors_{0}, connects_{0};
};

/// One that is attached, as opening each in turn tells.
struct FoundDhd {
  std::string name;
  int serial = -1;  ///< below 0: it does not say
  Error problem;    ///< why it can't be opened; `what` empty: it can
};
/// Opens and closes each. Fails without the library.
Result<std::vector<FoundDhd>> find_dhd_devices(const DhdOptions& options);

}  // namespace tangent
