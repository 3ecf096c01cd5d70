#include "tests/devices/usb/emulation/usb_model.h"

namespace tangent::emulation {

Bytes device_descriptor(std::uint16_t vendor, std::uint16_t product) {
  const auto low = [](std::uint16_t v) { return static_cast<std::uint8_t>(v & 0xffu); };
  const auto high = [](std::uint16_t v) { return static_cast<std::uint8_t>(v >> 8); };
  return {18,   1,    0x00, 0x02, 0, 0, 0, 64, low(vendor), high(vendor), low(product), high(product),
          0x00, 0x01, 0,    0,    0, 1};
}

Bytes configuration_descriptor(std::uint8_t cls, std::uint8_t sub, std::uint8_t protocol,
                               std::span<const std::uint8_t> endpoints) {
  const auto count = static_cast<std::uint8_t>(endpoints.size());
  const auto total = static_cast<std::uint8_t>(9 + 9 + 7 * endpoints.size());
  Bytes d{9, 2, total, 0, 1, 1, 0, 0x80, 50, 9, 4, 0, 0, count, cls, sub, protocol, 0};
  for (const std::uint8_t endpoint : endpoints) d.insert(d.end(), {7, 5, endpoint, 3, 64, 0, 1});
  return d;
}

}  // namespace tangent::emulation
