// An emulated USB device from the firmware's side: packets and control requests in, packets out, a 1 ms tick.
// Independent of how it is attached: both emulations of usbfs use the same model through the usbfs board.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tangent::emulation {

using Bytes = std::vector<std::uint8_t>;

struct ControlSetup {
  std::uint8_t request_type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

/// Bus fault of a packet that is not delivered.
enum class BusFault { none, stall, time_out, error };

class UsbModel {
 public:
  virtual ~UsbModel() = default;
  virtual Bytes descriptors() const = 0;  ///< device, configuration, interfaces, endpoints
  virtual void on_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) = 0;
  /// Bytes of an IN request (empty: none), or false to stall.
  virtual bool on_control(const ControlSetup& setup, Bytes& answer) = 0;
  virtual void tick() = 0;   ///< a millisecond passed
  virtual void reset() = 0;  ///< power came back

  /// Packets waiting for the host; the board takes them.
  std::deque<Bytes> in_packets;
  bool bulk = false;  ///< its endpoints; a host that asks for interrupt transfers is refused, as by Linux
  BusFault next_in = BusFault::none, next_out = BusFault::none;  ///< for the next packet alone
};

Bytes device_descriptor(std::uint16_t vendor, std::uint16_t product);
/// One configuration of one interface with interrupt endpoints of 64 bytes.
Bytes configuration_descriptor(std::uint8_t cls, std::uint8_t sub, std::uint8_t protocol,
                               std::span<const std::uint8_t> endpoints);

}  // namespace tangent::emulation
