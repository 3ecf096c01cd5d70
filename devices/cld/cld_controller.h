// A contact display whose microcontroller speaks the CLD protocol (devices/cld_protocol.md), over USB.
//
//   servo thread                 link's thread
//   exchange  -- commands -->    frames out, packed into packets
//             <-- telemetry --   packets in, parsed
// The two threads share these rings and a few atomics; neither waits for the other. The state is that of the newest
// telemetry, with one exception: a device that reports ready but was not homed by this host since it was plugged in
// counts as not homed (`firmware`).
#pragma once

#include "devices/base/mailbox.h"
#include "devices/base/ring.h"
#include "devices/cld/cld_messages.h"
#include "devices/contact_display.h"
#include "devices/usb/usb_link.h"

#include <array>
#include <atomic>

namespace tangent {

/// Endpoints and interface class as given in devices/cld_protocol.md.
UsbLinkOptions cld_link_options();

struct CldControllerOptions {
  UsbLinkOptions link = cld_link_options();
  double silence_s = 0.1;       ///< no telemetry for this long: fault `disconnected`
  double info_timeout_s = 0.5;  ///< no valid info message for this long after opening: fault `firmware`
  UsbTap* tap = nullptr;
};

class CldController final : public ContactDisplay, private UsbLinkHandler {
 public:
  explicit CldController(const CldControllerOptions& options = {});
  ~CldController() override { close(); }

  /// Those of the paper's CLD; what the connected firmware reports about itself is in `report`.
  const DisplayCapabilities& capabilities() const override { return capabilities_; }
  /// Starts the link's thread, which looks for the device; it may be plugged in later. Fails without libusb, or when
  /// already open.
  Status open() override;
  void close() override;
  DisplaySample exchange(const DisplayCommand& command, double dt_s) noexcept override;
  bool report(LinkReport& out) const override;
  /// The link's thread sends a stop before anything else that is queued.
  bool emergency_stop() noexcept override;

  /// Servo thread. Sends the settings if they changed; settings other than the defaults are also sent to every device
  /// that connects later.
  void set_controller(const ControllerSettings& settings) noexcept override;

 private:
  struct Outgoing {
    CldType type = CldType::target;
    std::int32_t target_nm = 0;
  };
  struct Heard {
    CldTelemetry telemetry;
    std::int64_t at_ns = 0;
    std::uint32_t connection = 0;
  };

  // Link's thread.
  void on_open(UsbLink& link) noexcept override;
  void on_packet(UsbLink& link, std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept override;
  void on_control_done(UsbLink&, bool, std::int64_t) noexcept override {}
  void on_turn(UsbLink& link, std::int64_t now_ns) noexcept override;
  void on_closed() noexcept override;
  void take_frame(const CldFrame& frame, std::int64_t now_ns) noexcept;
  void take_info(const CldFrame& frame) noexcept;
  void take_telemetry(const CldFrame& frame, std::int64_t now_ns) noexcept;
  void put_frame(const CldFrame& frame, std::int64_t now_ns) noexcept;
  void put_settings(std::int64_t now_ns) noexcept;
  void flush() noexcept;

  // Servo thread.
  void hear() noexcept;
  DeviceState state_now(std::int64_t now_ns, DeviceFault& fault) noexcept;
  void request(DeviceRequest request, DeviceState state) noexcept;

  CldControllerOptions options_;
  DisplayCapabilities capabilities_;
  UsbLink link_;
  Ring<Outgoing> commands_{256};
  Ring<Heard> telemetry_{1024};
  Mailbox<ControllerSettings> new_settings_;  ///< servo to link
  std::atomic<bool> stop_now_{false};         ///< any thread to link

  // Written by the link's thread, read by any thread.
  std::atomic<std::uint32_t> connection_{0};  ///< odd while connected, incremented on every change
  std::atomic<std::uint64_t> info_travel_nm_{0}, info_step_pm_{0}, info_rates_{0};
  std::atomic<std::uint32_t> info_serial_{0}, info_connection_{0}, unfit_connection_{0};
  std::atomic<std::uint16_t> info_firmware_{0};
  std::atomic<std::uint64_t> frames_{0}, crc_errors_{0}, skipped_bytes_{0}, cut_packets_{0}, lost_{0}, doubled_{0},
      late_{0}, lost_by_device_{0}, refused_{0}, unsent_{0};
  std::array<std::atomic<std::uint64_t>, 8> last_packet_{};
  std::atomic<std::uint32_t> last_packet_bytes_{0};
  LogHistogram round_trip_us_, arrival_us_;

  // Link's thread.
  CldParser parser_;
  CldSequence sequence_;
  std::uint16_t next_sequence_ = 0, last_heard_sequence_ = 0;
  std::array<std::int64_t, 256> sent_ns_{};
  std::array<std::uint8_t, kUsbPacketBytes> packet_{};
  std::size_t packet_held_ = 0;
  std::int64_t last_telemetry_ns_ = 0, opened_ns_ = 0, next_hello_ns_ = 0;
  bool heard_any_ = false;
  ControllerSettings settings_;
  bool settings_unsent_ = false;

  // Servo thread.
  ControllerSettings last_settings_;
  bool opened_ = false;
  Heard newest_;
  std::uint32_t homed_connection_ = 0, lost_connection_ = 0;
  bool ever_heard_ = false;
};

}  // namespace tangent
