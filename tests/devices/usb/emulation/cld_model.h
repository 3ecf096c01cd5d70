// Emulated firmware of a CLD controller: the protocol over the same mechanism model as the simulated display's.
#pragma once

#include "devices/cld/cld_messages.h"
#include "devices/simulated/cld_mechanism.h"
#include "tests/devices/usb/emulation/usb_model.h"

#include <map>

namespace tangent::emulation {

/// Faults of the telemetry stream, for one packet each.
enum class WireFault { none, split, merged, garbage, doubled, out_of_order, crc_error, empty };

class CldModel final : public UsbModel {
 public:
  std::uint16_t watchdog_ms = 50;
  bool watchdog_on = true;            ///< off: stalls of the test machine do not trip it
  bool has_firmware = true;           ///< false: never answers
  std::uint16_t telemetry_hz = 1000;  ///< 0: an info that the host must reject
  bool encoder_stuck = false;
  bool telemetry_on = true;
  int homing_ticks = 100;
  WireFault next_wire = WireFault::none;
  /// Targets in order of arrival, and how often each sequence number arrived.
  std::vector<std::int32_t> targets;
  std::map<std::uint32_t, int> heard;  ///< frames by running sequence number
  std::uint64_t watchdog_fired = 0, telemetry_sent = 0;

  Bytes descriptors() const override;
  void on_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) override;
  bool on_control(const ControlSetup& setup, Bytes& answer) override;
  void tick() override;
  void reset() override;

  /// As after a power cycle.
  void forget_settings() {
    mechanism_ = CldMechanism();
    lowest_nm_ = -10'000'000;
    highest_nm_ = 10'000'000;
  }

  CldDeviceState state() const { return state_; }
  const CldMechanism& mechanism() const { return mechanism_; }

 private:
  void take(const CldFrame& frame);
  void refuse(const CldFrame& frame, std::uint8_t reason);
  void run_drive();
  void send(const CldFrame& frame);
  void put(Bytes bytes);

  CldMechanism mechanism_;
  CldParser parser_;
  CldSequence sequence_;
  CldDeviceState state_ = CldDeviceState::idle;
  CldDeviceFault fault_ = CldDeviceFault::none;
  std::uint16_t out_sequence_ = 0, heard_sequence_ = 0;
  std::uint32_t time_us_ = 0, running_ = 0;
  std::int32_t target_nm_ = 0, lowest_nm_ = -10'000'000, highest_nm_ = 10'000'000;
  int homing_left_ = 0, since_target_ = 0, stuck_for_ = 0;
  double stuck_at_ = 0.0;
  Bytes kept_;  ///< waits for the next frame: merged, out of order
};

}  // namespace tangent::emulation
