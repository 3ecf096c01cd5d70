// Emulated Novint Falcon: its FTDI chip, its boot loader, its firmware's packets, homing, and its mechanics: a finger
// of some mass on the three legs, held by a hand, that torques push about.
//
// Made from the same public descriptions as the driver: what they have wrong, both have.
#pragma once

#include "devices/falcon/falcon_codec.h"
#include "devices/falcon/falcon_kinematics.h"
#include "tests/devices/usb/emulation/usb_model.h"

#include <functional>
#include <string>

namespace tangent::emulation {

/// What goes wrong while it runs, until it is put back to none.
enum class FalconFault { none, silent, garbage, cut, far_away, legs_apart, unhomed, frozen };

/// What goes wrong while the firmware is loaded, `times` times.
struct UploadFault {
  enum Kind { none, silence, wrong_echo, missing_byte } kind = none;
  enum Step { greeting, letter, piece } step = greeting;
  int at_piece = 0;
  int times = 1;
};

class FalconModel final : public UsbModel {
 public:
  FalconModel() { bulk = true; }

  std::string serial = "F00001";  ///< empty: it says none
  bool running = true;            ///< its firmware
  Bytes firmware;                 ///< that its boot loader starts; any other doesn't run
  bool leading_zero = false;      ///< before the greeting's answer
  bool echoes = false;            ///< a boot loader that echoes at any rate
  bool answers_at_once = false;   ///< not with the next millisecond: then nothing depends on the clock's thread
  UploadFault upload;
  FalconFault fault = FalconFault::none;
  int homing_ticks = 30;            ///< for which the homing bit is set until each leg has found its zero
  double counts_per_nm = 10'000.0;  ///< its true torque scale
  double mass_kg = 0.2, hand_n_per_m = 2000.0, hand_n_s_per_m = 20.0;
  Vec3 hand_m = kFalconCentre_m;  ///< where the hand holds it
  std::function<void()> when_asked_for_serial;

  // What happened.
  std::uint64_t commands = 0, bad_commands = 0, uploads = 0, pushed_unhomed = 0;
  FalconCommand last;
  std::uint16_t baud = 0, latency_ms = 16;

  const Vec3& place_m() const { return place_; }
  bool homed() const { return homed_ == 7; }
  bool pushes() const { return running && last.torque != FalconCommand{}.torque; }

  Bytes descriptors() const override;
  void on_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) override;
  bool on_control(const ControlSetup& setup, Bytes& answer) override;
  void tick() override;
  void reset() override;

 private:
  void take(const FalconPacket& packet);
  void answer();
  void bytes_in(std::span<const std::uint8_t> bytes);
  void boot(std::span<const std::uint8_t> bytes);
  bool goes_wrong(UploadFault::Step step);
  void say(Bytes bytes, UploadFault::Step step);
  void move();

  FalconParser parser_;
  Vec3 place_ = kFalconCentre_m, velocity_{0.0};
  Bytes loaded_;
  bool dtr_ = false, greeted_ = false, lettered_ = false;
  int pieces_ = 0, unanswered_ = 0, homing_for_ = 0, since_status_ = 0;
  std::uint8_t homed_ = 0;
  FalconEncoders said_{};  // last
};

}  // namespace tangent::emulation
