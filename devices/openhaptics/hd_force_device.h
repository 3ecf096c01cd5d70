// A 3D Systems Touch or a PHANToM through the maker's OpenHaptics (HDAPI), which keeps the time: its scheduler calls us
// at 1 kHz from a thread of its own.
//
//   scheduler's thread                    keeper's thread                       owner's thread
//   called -> tick -> exchange: a frame   finds a lost device, a scheduler      open, close, start_calling,
//   (state, force, every error code)      that is silent, an emergency; stops   stop_calling
//                                         the scheduler, looks for the device
// A frame is begun and ended within one exchange, and in the scheduler's thread alone, as HDAPI asks. While the device
// is away the keeper calls the tick instead, so that the loop goes on, and says that it is absent. The two never run at
// once: the keeper calls only after hdStopScheduler has returned, and the last call with it.
//
// It is homed by hand: with the stylus in the inkwell (or by itself, where the device can), it is calibrated in the
// scheduler's thread, as HDAPI asks, and ready from then on. Nothing moves it.
#pragma once

#include "devices/force_device.h"
#include "devices/openhaptics/hd_api.h"
#include "devices/openhaptics/hd_frame.h"
#include "devices/vendor_options.h"

#include <atomic>
#include <cstdint>
#include <thread>

namespace tangent {

class HdForceDevice final : public ForceDevice {
 public:
  explicit HdForceDevice(HdOptions options = {});
  ~HdForceDevice() override { close(); }

  /// Constant from open on: only the open device says what it can do.
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  /// Loads the library, once, and opens the device. Fails without library, device or permission, when the library is
  /// too old, when several are set up and none was chosen (they are listed), and when this program has opened one
  /// already: the library has one scheduler.
  Status open() override;
  /// Zero force in a last frame, the scheduler stopped, the callback taken away, the output disabled, the device
  /// released: in this order.
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  /// The keeper disables the force and stops the scheduler.
  bool emergency_stop() noexcept override;

  bool calls_us() const override { return true; }
  Status start_calling(const DeviceTick& tick) override;
  void stop_calling() override;
  /// What it is, and the newest error in words.
  bool report(LinkReport& out) const override;

 private:
  struct Reading {
    double position_mm[3], velocity_mm_per_s[3], transform[16];
    int buttons;
  };

  // Owner's or keeper's thread, while the scheduler is stopped.
  Status attach();
  Status learn();
  Status start_scheduler();
  void stop_scheduler();
  void detach(DeviceFault fault);
  hd::ErrorCode drain() noexcept;

  // Scheduler's thread.
  static hd::CallbackCode called(void* device) noexcept;
  void zero_frame() noexcept;
  ForceSample frame(const ForceCommand& command) noexcept;
  void read(Reading& reading) noexcept;
  DeviceFault judge(const Reading& reading) const noexcept;
  void note(hd::ErrorCode code) noexcept;
  void go_on() noexcept;
  void calibrate() noexcept;

  // Keeper's thread.
  void keep() noexcept;
  void watch() noexcept;
  void stand_in(std::int64_t now_ns) noexcept;
  bool wait_for_last_call() noexcept;

  HdOptions options_;
  ForceCapabilities capabilities_;
  std::string identity_;
  hd::Api api_{};
  hd::Handle device_ = hd::kInvalidHandle;
  hd::SchedulerHandle callback_ = 0;
  hd::Enum style_ = 0;  ///< of calibration
  hd::Corners reach_{};
  Vec3 centre_m_{0.0};
  bool loaded_ = false, opened_ = false;
  DeviceTick tick_;
  std::thread keeper_;
  std::int64_t next_try_ns_ = 0;

  // Of whoever calls the tick.
  DeviceStateMachine machine_;
  ForceSample newest_;
  int clean_frames_ = 0;
  bool in_frame_call_ = false, fault_shown_ = false;

  // Between threads.
  std::atomic<bool> attached_{false}, keeper_ends_{false}, stopping_{false}, lost_{false}, emergency_{false};
  std::atomic_flag ticking_ = ATOMIC_FLAG_INIT;  ///< a call goes on, of the scheduler or of the keeper
  std::atomic<std::int64_t> last_call_ns_{0};
  std::atomic<std::uint32_t> newest_error_{0}, needs_{0};
  std::atomic<std::uint64_t> frames_{0}, errors_{0}, connects_{0}, last_frames_{0};
};

}  // namespace tangent
