// Keeps one USB device open: finds it, opens it, keeps transfers in flight, notices when it is unplugged, and reopens
// it when it is plugged in again. Does not interpret the packets.
//
// All of it runs in the link's own thread. IN transfers are always in flight; OUT and control transfers come from a
// fixed pool; after opening it does not allocate. Other threads only wake it. Uses libusb's hot-plug events where
// available, and scans the bus twice a second.
#pragma once

#include "devices/usb/usb_types.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace tangent {

struct UsbLinkOptions {
  UsbMatch match;
  int interface_number = 0;       ///< interface to claim; -1: none, control transfers only
  std::uint8_t in_endpoint = 0;   ///< 0: none
  std::uint8_t out_endpoint = 0;  ///< 0: none
  int in_transfers = 8;           ///< in flight at any time
  int out_transfers = 8;          ///< pool size, OUT and control together
  unsigned time_out_ms = 100;     ///< of OUT and control transfers
  bool bulk = false;              ///< endpoints are bulk ones; false: interrupt
  bool ask_serial = false;        ///< reads the serial number when it opens the device
};

struct UsbControl {
  std::uint8_t request_type = 0x40;  ///< host to device, vendor, device
  std::uint8_t request = 0;
  std::uint16_t value = 0, index = 0;
};

class UsbLink;

/// Receives the link's events. All calls come from the link's thread and must not wait.
class UsbLinkHandler {
 public:
  virtual ~UsbLinkHandler() = default;
  /// The device was opened and its IN transfers were submitted.
  virtual void on_open(UsbLink& link) noexcept = 0;
  /// An IN packet; `bytes` are valid during the call. Times are those of usb_now_ns.
  virtual void on_packet(UsbLink& link, std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept = 0;
  /// A control transfer has ended; `good`: without an error.
  virtual void on_control_done(UsbLink& link, bool good, std::int64_t now_ns) noexcept = 0;
  /// After every wake-up, and at least every 5 ms while open.
  virtual void on_turn(UsbLink& link, std::int64_t now_ns) noexcept = 0;
  /// The device was closed or unplugged.
  virtual void on_closed() noexcept = 0;
};

class UsbLink {
 public:
  /// `handler` and `tap` must outlive it; tap may be null.
  UsbLink(UsbLinkOptions options, UsbLinkHandler& handler, UsbTap* tap = nullptr);
  ~UsbLink();
  UsbLink(const UsbLink&) = delete;
  UsbLink& operator=(const UsbLink&) = delete;

  /// Starts the thread; the device may be attached later. Fails without libusb or when it can't be initialised.
  Status start();
  /// Sends what is queued, closes the device and joins the thread. Owner's thread; harmless when not started.
  void stop();

  /// Makes the thread call on_turn soon. This and the next three: any thread, at any time, without waiting.
  void wake() noexcept;
  bool connected() const noexcept;
  UsbProblem problem() const noexcept;  ///< why it is not connected
  const UsbCounters& counters() const noexcept;

  /// Link's thread. False, and counted as refused, when all transfers are in flight. Precondition: bytes.size() <=
  /// kUsbPacketBytes.
  bool send(std::span<const std::uint8_t> bytes) noexcept;
  bool send_control(const UsbControl& control) noexcept;
  /// Link's thread, from on_open to on_closed: of the device that is open. Empty: it says none, or was not asked.
  const std::string& serial() const noexcept;
  /// Link's thread: whether a transfer is free.
  bool can_send() const noexcept;
  /// Link's thread: closes the device and looks for it again (it sends invalid data).
  void reconnect() noexcept;

  struct Impl;  ///< defined by the transport

 private:
  std::unique_ptr<Impl> impl_;
};

/// CLOCK_MONOTONIC in nanoseconds. Any thread.
std::int64_t usb_now_ns() noexcept;

}  // namespace tangent
