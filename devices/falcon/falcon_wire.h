// What the Falcon's protocol needs of a transport: the USB link, or a test that steps the time itself.
#pragma once

#include "devices/usb/usb_link.h"

namespace tangent {

class FalconWire {
 public:
  virtual ~FalconWire() = default;
  virtual bool send(std::span<const std::uint8_t> bytes) noexcept = 0;
  virtual bool send_control(const UsbControl& control) noexcept = 0;
  virtual bool can_send() const noexcept = 0;
};

}  // namespace tangent
