// Types shared by the USB transport and its users. Nothing here needs libusb.
#pragma once

#include "core/base/result.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent {

/// Selects devices either by vendor and products or by an interface's class.
struct UsbMatch {
  std::uint16_t vendor = 0;                                    ///< 0: any
  std::vector<std::uint16_t> products;                         ///< empty: any
  std::optional<std::array<std::uint8_t, 3>> interface_class;  ///< class, subclass, protocol
  std::string serial{};                                        ///< empty: any
  bool alone = false;                                          ///< of several, without a serial number, none is taken
};

/// Why a device can't be used.
enum class UsbProblem : std::uint8_t {
  none,
  no_library,
  not_attached,
  no_permission,
  busy,
  wrong_interface,
  several,
  other
};

/// Message for people: what is wrong and what to do. `detail`: libusb's name of the error, or empty.
Error usb_error(UsbProblem problem, const std::string& where, const std::string& detail = {});

struct UsbDeviceInfo {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0, address = 0;
  std::string product_name{}, serial{};   ///< empty where they can't be read
  UsbProblem problem = UsbProblem::none;  ///< why it could not be opened
  std::string problem_detail{};
};

/// Lists the attached devices that match; opens each for a moment to see whether that works. Fails without libusb or
/// when it can't be initialised. Not in the servo thread: it blocks.
Result<std::vector<UsbDeviceInfo>> list_usb_devices(const UsbMatch& match, int interface_number);

/// Whether the program was built with libusb.
bool usb_built_in();

inline constexpr std::size_t kUsbPacketBytes = 64;

/// Written by the link's thread, read by any thread. They never go back.
struct UsbCounters {
  std::atomic<std::uint64_t> packets_in{0}, packets_out{0}, controls{0};
  std::atomic<std::uint64_t> empty_packets{0};  ///< IN packets of zero bytes
  std::atomic<std::uint64_t> short_packets{0};  ///< OUT and control: the device took less than it was sent
  std::atomic<std::uint64_t> stalls{0}, time_outs{0}, errors{0};
  std::atomic<std::uint64_t> refused_sends{0};  ///< all transfers were in flight
  std::atomic<std::uint64_t> connects{0};
};

/// Sees every packet, for a recorder. Called in the link's thread; must not wait.
class UsbTap {
 public:
  enum class Direction : std::uint8_t { in, out, control };
  virtual ~UsbTap() = default;
  /// `time_ns`: usb_now_ns. `status`: libusb's transfer status, 0 if completed. `bytes` are valid during the call.
  virtual void packet(Direction direction, std::int64_t time_ns, std::span<const std::uint8_t> bytes,
                      int status) noexcept = 0;
};

}  // namespace tangent
