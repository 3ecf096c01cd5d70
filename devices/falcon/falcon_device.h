// A Novint Falcon on USB. Never run on hardware: written from public descriptions of its protocol and tested against an
// emulated one.
#pragma once

#include "devices/falcon/falcon_driver.h"

#include <memory>
#include <mutex>

namespace tangent {

class FalconDevice final : public ForceDevice, private UsbLinkHandler, private FalconWire {
 public:
  explicit FalconDevice(const FalconOptions& options = {});
  ~FalconDevice() override { close(); }

  const ForceCapabilities& capabilities() const override { return capabilities_; }
  /// Reads the firmware's file, then starts the link's thread, which looks for the device; it may be plugged in later.
  /// Fails on a firmware that is not known, without libusb, and where several are attached and none is named.
  Status open() override;
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  /// The link's thread sends a command without torque at once; faulted from then on.
  bool emergency_stop() noexcept override;
  bool report(LinkReport& out) const override;

 private:
  void on_open(UsbLink& link) noexcept override;
  void on_packet(UsbLink&, std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept override;
  void on_control_done(UsbLink&, bool good, std::int64_t now_ns) noexcept override {
    driver_->line().control_done(good, now_ns);
  }
  void on_turn(UsbLink&, std::int64_t now_ns) noexcept override { driver_->line().turn(*this, now_ns); }
  void on_closed() noexcept override { driver_->line().closed(); }

  bool send(std::span<const std::uint8_t> bytes) noexcept override { return link_.send(bytes); }
  bool send_control(const UsbControl& control) noexcept override { return link_.send_control(control); }
  bool can_send() const noexcept override { return link_.can_send(); }

  Status check_attached() const;
  std::uint32_t stops() const;
  std::string problem() const;  ///< under driver_lock_

  FalconOptions options_;
  ForceCapabilities capabilities_;
  UsbLink link_;
  mutable std::mutex driver_lock_;        ///< held to replace it, by an emergency stop and by a report
  std::unique_ptr<FalconDriver> driver_;  ///< from the start; a new one with each open
  std::array<std::atomic<std::uint64_t>, 8> last_packet_{};
  std::atomic<std::uint32_t> last_packet_bytes_{0};
  mutable std::mutex serial_lock_;  ///< held for a copy, once a connection
  std::string serial_;              ///< of the one that was connected last
  std::uint32_t stops_ = 0;         ///< emergency stops, under driver_lock_
  bool opened_ = false;
};

}  // namespace tangent
