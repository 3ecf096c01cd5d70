// A contact display built from a hobby servo on a Pololu Maestro. Open loop: no measured position, so the commanded one
// is reported.
//
// The Maestro has no watchdog for USB commands: when the program dies, the servo holds its last position. Where that
// could hurt a person, use a controller with a watchdog (devices/cld_protocol.md).
#pragma once

#include "devices/base/mailbox.h"
#include "devices/contact_display.h"
#include "devices/maestro/maestro_codec.h"
#include "devices/usb/usb_link.h"

#include <atomic>

namespace tangent {

UsbLinkOptions maestro_link_options();

struct MaestroOptions {
  std::uint8_t channel = 0;
  std::uint16_t speed = 0;  ///< see maestro_speed
  std::uint8_t acceleration = 0;
  MaestroCalibration calibration{};
  double settle_s = 0.5;  ///< duration of homing: time to reach the middle
  UsbLinkOptions link = maestro_link_options();
  UsbTap* tap = nullptr;
};

class MaestroDisplay final : public ContactDisplay, private UsbLinkHandler {
 public:
  explicit MaestroDisplay(const MaestroOptions& options = {});
  ~MaestroDisplay() override { close(); }

  const DisplayCapabilities& capabilities() const override { return capabilities_; }
  /// Starts the link's thread, which looks for the device; it may be plugged in later. Fails on an invalid calibration
  /// or without libusb.
  Status open() override;
  void close() override;
  /// The sample's position is the one last commanded, rounded to the Maestro's step.
  DisplaySample exchange(const DisplayCommand& command, double dt_s) noexcept override;
  bool report(LinkReport& out) const override;
  /// The link's thread switches the servo off; faulted from then on.
  bool emergency_stop() noexcept override;

 private:
  void on_open(UsbLink& link) noexcept override;
  void on_packet(UsbLink&, std::span<const std::uint8_t>, std::int64_t) noexcept override {}
  void on_control_done(UsbLink& link, bool good, std::int64_t now_ns) noexcept override;
  void on_turn(UsbLink& link, std::int64_t now_ns) noexcept override;
  void on_closed() noexcept override;
  void update_state(const DisplayCommand& command, double dt_s) noexcept;

  MaestroOptions options_;
  DisplayCapabilities capabilities_;
  UsbLink link_;
  Mailbox<std::uint16_t> targets_;            ///< quarter us, 0: off; servo to link
  std::atomic<bool> stop_now_{false};         ///< any thread to link
  std::atomic<bool> was_stopped_{false};      ///< any thread to servo
  std::atomic<std::uint32_t> connection_{0};  ///< odd while connected
  std::atomic<std::uint32_t> answered_{0};    ///< connection in which a setting was acknowledged
  std::atomic<std::uint32_t> failures_{0};    ///< consecutive failed control transfers
  LogHistogram round_trip_us_;

  // Link's thread.
  static constexpr int kMostInFlight = 2;
  int in_flight_ = 0;
  std::uint16_t wanted_ = 0, sent_ = 0;
  bool unsent_ = false;
  std::int64_t sent_ns_ = 0;

  // Servo thread.
  bool opened_ = false;
  DeviceStateMachine machine_;
  std::uint32_t seen_connection_ = 0;
  double homing_for_s_ = 0.0, position_m_ = 0.0;
};

}  // namespace tangent
