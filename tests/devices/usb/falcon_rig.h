// The Falcon's driver, the safety gate and an emulated Falcon, stepped tick by tick without USB, threads and clock.
#pragma once

#include "devices/falcon/falcon_driver.h"
#include "devices/safety_gate.h"
#include "tests/devices/usb/emulation/falcon_model.h"

#include <doctest/doctest.h>

#include <deque>

namespace tangent::emulation {

/// A firmware of this many bytes, no two pieces alike.
inline Bytes falcon_firmware_of(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  return bytes;
}

class FalconRig : public FalconWire {
 public:
  static constexpr double kTick_s = 1e-3;

  explicit FalconRig(const FalconOptions& options = {}, const Bytes& firmware = {},
                     const FalconDriver::Firmwares& kept = {})
      : driver(options, firmware, kept), gate(limits_of(driver.capabilities())) {
    model.firmware = firmware;
  }

  FalconModel model;
  FalconDriver driver;
  SafetyGate gate;
  ForceSample sample;
  GateOutput passed;
  Vec3 wanted_n{0.0};  ///< what the scene would push with
  bool servo_runs = true, takes_transfers = true, plugged = false;
  std::int64_t now_ns = 1'000'000'000;
  std::uint64_t ticks = 0;

  void plug_in() {
    model.reset();
    plugged = true;
    driver.opened(model.serial, now_ns);
  }
  void unplug() {
    plugged = false;
    answered_.clear();
    driver.line().closed();
  }

  /// 1 ms: the device's, then the link's, then the servo's.
  void tick(DeviceRequest request = DeviceRequest::none) {
    now_ns += 1'000'000;
    ++ticks;
    if (plugged) run_link(true);
    if (!servo_runs) return;
    const Vec3 force = gate.before_sending(kTick_s);
    sample = driver.exchange({.tick = ticks, .force_n = force, .request = request}, now_ns);
    if (plugged) run_link(false);
    GateInput in;
    in.force_n = wanted_n;
    in.force_device = sample.state;
    in.position_m = sample.position_m;
    in.position_age_s = sample.age_s;
    passed = gate.pass(in, kTick_s);
  }
  /// Ticks until it is in this state, `most` at most.
  bool reach(DeviceState state, int most = 2000) {
    for (int i = 0; i < most; ++i) {
      if (sample.state == state) return true;
      tick();
    }
    return sample.state == state;
  }
  /// Homed: here it needs no hand.
  void make_ready() { REQUIRE(reach(DeviceState::ready)); }
  void push(const Vec3& force_n, int for_ticks = 400) {
    wanted_n = force_n;
    gate.arm();
    for (int i = 0; i < for_ticks; ++i) tick();
  }
  /// Whether we make it push: the device turns its motors by our command, or, when it is gone, we would.
  bool pushes() const {
    return sample.force_n != Vec3(0.0) && (!plugged || model.last.torque != FalconCommand{}.torque);
  }
  bool noticed() const { return sample.state != DeviceState::ready || gate.state() == GateState::faulted; }

  bool send(std::span<const std::uint8_t> bytes) noexcept override {
    if (takes_transfers) model.on_out(0x02, bytes);
    return takes_transfers;
  }
  bool send_control(const UsbControl& c) noexcept override {
    Bytes answer;
    answered_.push_back(takes_transfers && model.on_control({c.request_type, c.request, c.value, c.index, 0}, answer));
    return true;
  }
  bool can_send() const noexcept override { return true; }

 private:
  static GateLimits limits_of(const ForceCapabilities& can) {
    GateLimits limits;
    limits.peak_force_n = can.peak_force_n;
    limits.continuous_force_n = can.continuous_force_n;
    limits.workspace_half_size_m = can.workspace_half_size_m;
    limits.resolution_m = can.position_resolution_m;
    return limits;
  }
  void run_link(bool a_millisecond_passed) {
    FalconLine& line = driver.line();
    if (a_millisecond_passed) model.tick();
    for (int round = 0; round < 4; ++round) {  // what an answer is followed by, within the millisecond
      while (!model.in_packets.empty()) {
        const Bytes packet = model.in_packets.front();
        model.in_packets.pop_front();
        line.packet(packet, now_ns);
      }
      while (!answered_.empty()) {
        const bool good = answered_.front();
        answered_.pop_front();
        line.control_done(good, now_ns);
      }
      line.turn(*this, now_ns);
    }
  }

  std::deque<bool> answered_;
};

}  // namespace tangent::emulation
