// One USB device kept open: finds it, opens it, keeps packets flowing, notices when it is pulled, and comes back when
// it is plugged in again. Knows nothing of what the packets mean.
//
// A thread of its own does all of it. IN transfers are always in flight, OUT and control transfers come from a fixed
// pool; after opening nothing allocates. Other threads only wake it. Hot-plug by libusb where it can; where it can't,
// a look at the bus twice a second.
#pragma once

#include "devices/usb/usb_types.h"

#include <cstdint>
#include <memory>
#include <span>

namespace tangent {

struct UsbLinkOptions {
  UsbMatch match;
  int interface_number = 0;       ///< claimed; -1: none, control transfers alone
  std::uint8_t in_endpoint = 0;   ///< 0: none
  std::uint8_t out_endpoint = 0;  ///< 0: none
  int in_transfers = 8;           ///< in flight at any time
  int out_transfers = 8;          ///< OUT and control together
  unsigned time_out_ms = 100;     ///< of OUT and control transfers
};

struct UsbControl {
  std::uint8_t request_type = 0x40;  ///< host to device, vendor, device
  std::uint8_t request = 0;
  std::uint16_t value = 0, index = 0;
};

class UsbLink;

/// What is done with the packets. Called in the link's thread alone.
class UsbLinkHandler {
 public:
  virtual ~UsbLinkHandler() = default;
  virtual void on_open(UsbLink& link) noexcept = 0;
  virtual void on_packet(UsbLink& link, std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept = 0;
  virtual void on_control_done(UsbLink& link, bool good, std::int64_t now_ns) noexcept = 0;
  /// After every wake-up, and at least every 5 ms while open.
  virtual void on_turn(UsbLink& link, std::int64_t now_ns) noexcept = 0;
  virtual void on_closed() noexcept = 0;
};

class UsbLink {
 public:
  /// `handler` and `tap` must outlive it; tap may be null.
  UsbLink(UsbLinkOptions options, UsbLinkHandler& handler, UsbTap* tap = nullptr);
  ~UsbLink();
  UsbLink(const UsbLink&) = delete;
  UsbLink& operator=(const UsbLink&) = delete;

  /// Starts the thread; the device may come later. Fails when there is no USB.
  Status start();
  void stop();

  /// Any thread; does not wait.
  void wake() noexcept;
  bool connected() const noexcept;
  UsbProblem problem() const noexcept;  ///< why it isn't connected
  const UsbCounters& counters() const noexcept;

  /// Link's thread. False, and counted, when every transfer is in flight. Precondition: bytes.size() <=
  /// kUsbPacketBytes.
  bool send(std::span<const std::uint8_t> bytes) noexcept;
  bool send_control(const UsbControl& control) noexcept;
  /// Link's thread: whether a transfer is free.
  bool can_send() const noexcept;
  /// Link's thread: closes and looks for the device anew (it talks nonsense).
  void reconnect() noexcept;

  struct Impl;  ///< known to the transport alone

 private:
  std::unique_ptr<Impl> impl_;
};

/// CLOCK_MONOTONIC.
std::int64_t usb_now_ns() noexcept;

}  // namespace tangent
