// What the USB transport tells and is told. Nothing here needs libusb.
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

/// Which devices are meant: by vendor and products, or by the class of an interface. One of the two.
struct UsbMatch {
  std::uint16_t vendor = 0;                                    ///< 0: any
  std::vector<std::uint16_t> products;                         ///< empty: any
  std::optional<std::array<std::uint8_t, 3>> interface_class;  ///< class, subclass, protocol
};

/// Why a device can't be used.
enum class UsbProblem : std::uint8_t { none, no_library, not_attached, no_permission, busy, wrong_interface, other };

/// "what; what to do", for people. `detail`: libusb's name of the error, or empty.
Error usb_error(UsbProblem problem, const std::string& where, const std::string& detail = {});

struct UsbDeviceInfo {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0, address = 0;
  std::string product_name{}, serial{};   ///< empty where they can't be read
  UsbProblem problem = UsbProblem::none;  ///< that opening it met
  std::string problem_detail{};
};

/// Attached devices that match; each is opened for a moment to see whether it can be. Fails when there is no USB.
Result<std::vector<UsbDeviceInfo>> list_usb_devices(const UsbMatch& match, int interface_number);

/// Whether the program was built with libusb.
bool usb_built_in();

inline constexpr std::size_t kUsbPacketBytes = 64;

/// Written by the link's thread, read by any. Each grows for ever.
struct UsbCounters {
  std::atomic<std::uint64_t> packets_in{0}, packets_out{0}, controls{0};
  std::atomic<std::uint64_t> empty_packets{0};  ///< IN packets without a byte
  std::atomic<std::uint64_t> short_packets{0};  ///< OUT and control: the device took less than it was sent
  std::atomic<std::uint64_t> stalls{0}, time_outs{0}, errors{0};
  std::atomic<std::uint64_t> refused_sends{0};  ///< all transfers were in flight
  std::atomic<std::uint64_t> connects{0};
};

/// Sees every packet as it passes, for a recorder. Link's thread; must not wait.
class UsbTap {
 public:
  enum class Direction : std::uint8_t { in, out, control };
  virtual ~UsbTap() = default;
  virtual void packet(Direction direction, std::int64_t time_ns, std::span<const std::uint8_t> bytes,
                      int status) noexcept = 0;
};

}  // namespace tangent
