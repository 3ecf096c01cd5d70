// Emulated Pololu Maestro: takes vendor requests and records each channel's target.
#pragma once

#include "tests/devices/usb/emulation/usb_model.h"

#include <array>

namespace tangent::emulation {

class MaestroModel final : public UsbModel {
 public:
  std::array<std::uint16_t, 6> targets{}, speeds{}, accelerations{};
  std::vector<std::uint16_t> history;  ///< targets of channel 0, in order
  bool stalls = false;
  std::string serial;  ///< ASCII; empty: it says none

  Bytes descriptors() const override {
    Bytes d = device_descriptor(0x1FFB, 0x0089);
    if (!serial.empty()) d[16] = kSerialString;
    const Bytes c = configuration_descriptor(0xFF, 0x00, 0x00, {});
    d.insert(d.end(), c.begin(), c.end());
    return d;
  }
  void on_out(std::uint8_t, std::span<const std::uint8_t>) override {}
  bool on_control(const ControlSetup& s, Bytes& answer) override {
    answer.clear();
    if (s.request_type == 0x80 && s.request == 6 && s.value >> 8 == 3 && !serial.empty())
      return string_descriptor(s.value & 0xffu, answer);
    const std::size_t channel = s.index & 0x7fu;
    if (stalls || s.request_type != 0x40 || channel >= targets.size()) return false;
    if (s.request == 0x85) {
      targets[channel] = s.value;
      if (channel == 0) history.push_back(s.value);
      return true;
    }
    if (s.request == 0x84) {
      ((s.index & 0x80u) != 0 ? accelerations : speeds)[channel] = s.value;
      return true;
    }
    return false;
  }
  bool string_descriptor(unsigned index, Bytes& answer) const {
    if (index == 0)
      answer = {4, 3, 0x09, 0x04};  // in English
    else if (index == kSerialString)
      answer = {static_cast<std::uint8_t>(2 + 2 * serial.size()), 3};
    for (std::size_t i = 0; index == kSerialString && i < serial.size(); ++i)
      answer.insert(answer.end(), {static_cast<std::uint8_t>(serial[i]), 0});
    return !answer.empty();
  }
  void tick() override {}
  void reset() override { targets = {}; }

 private:
  static constexpr std::uint8_t kSerialString = 3;
};

}  // namespace tangent::emulation
