// The Falcon's driver and the safety gate against an emulated Falcon, tick by tick: homing, force, faults.
#include "devices/falcon/falcon_calibration.h"
#include "tests/devices/usb/falcon_rig.h"
#include "tests/support/approx.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::emulation;

namespace {

double size_of(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

FalconOptions calibrated(double counts_per_nm = 10'000.0) {
  FalconOptions o;
  o.torque_counts_per_nm = counts_per_nm;
  return o;
}

}  // namespace

TEST_CASE("Falcon: until every leg is homed there is no force, and the lamps say so") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.model.homing_ticks = 300;
  REQUIRE(rig.reach(DeviceState::firmware));
  CHECK(rig.model.last.lamps == kFalconRed);
  rig.push({0.0, 0.0, 2.0}, 200);
  CHECK(rig.sample.state == DeviceState::homing);
  CHECK(rig.sample.force_n == Vec3(0.0));
  CHECK(rig.model.last.homing);
  CHECK(rig.model.last.lamps == kFalconBlue);
  CHECK(rig.driver.legs_homed() == 0);
  REQUIRE(rig.reach(DeviceState::ready));
  CHECK(rig.driver.legs_homed() == 3);
  for (int i = 0; i < 3; ++i) rig.tick();
  CHECK(rig.model.last.lamps == kFalconGreen);
  CHECK(rig.model.pushed_unhomed == 0);
  CHECK(rig.model.bad_commands == 0);
}

TEST_CASE("Falcon: the position is the finger's, within a step of the encoders, wherever the hand takes it") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  for (const Vec3& off : {Vec3(0.02, 0.0, 0.0), Vec3(0.0, -0.03, 0.01), Vec3(-0.02, 0.02, -0.03), Vec3(0.0)}) {
    rig.model.hand_m = kFalconCentre_m + off;
    for (int i = 0; i < 600; ++i) rig.tick();
    CHECK(size_of(rig.sample.position_m - (rig.model.place_m() - kFalconCentre_m)) < 100e-6);
    CHECK(size_of(rig.sample.position_m - off) < 1e-3);
    CHECK(rig.sample.age_s <= 1.5e-3);
  }
}

TEST_CASE("Falcon: calibrated, it pushes as hard as asked and in the direction asked, anywhere") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  for (const Vec3& off : {Vec3(0.0), Vec3(0.02, 0.01, 0.02), Vec3(-0.02, -0.02, -0.02)}) {
    rig.model.hand_m = kFalconCentre_m + off;
    for (const Vec3& force : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, -1.0, 0.0), Vec3(0.3, 0.4, 1.2)}) {
      rig.push(force, 900);
      REQUIRE(rig.sample.state == DeviceState::ready);
      // At rest the hand's spring carries it.
      const Vec3 felt = rig.model.hand_n_per_m * (rig.model.place_m() - rig.model.hand_m);
      CHECK(size_of(felt - force) < 0.02 * size_of(force));
      CHECK(size_of(rig.sample.force_n - force) < 1e-9);
    }
  }
}

TEST_CASE("Falcon: not calibrated, it says so, and pushes with no more than a newton's worth of low counts") {
  FalconRig rig;
  CHECK(rig.driver.capabilities().name.find("not calibrated") != std::string::npos);
  CHECK(rig.driver.capabilities().peak_force_n == kFalconUncalibratedPeak_n);
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 50.0}, 900);
  const double felt = rig.model.hand_n_per_m * size_of(rig.model.place_m() - rig.model.hand_m);
  CHECK(felt == approx(0.5).epsilon(0.02));  // half, where the public driver's 10,000 counts are true
  for (const int count : rig.model.last.torque) CHECK(std::abs(count) <= kFalconUncalibratedCounts);
}

TEST_CASE("Falcon: each that is plugged in pushes by the torque scale that is kept for it, and with 1 N without one") {
  FalconOptions options;
  options.kept["LEFT"] = {10'000.0, "", ""};
  options.kept["RIGHT"] = {20'000.0, "", ""};
  options.kept["NEW"] = {0.0, "named, and not calibrated", ""};
  struct Plugged {
    const char* serial;
    double true_scale, felt_n;
  };
  FalconRig rig(options);
  CHECK(rig.driver.capabilities().name == "Novint Falcon");
  CHECK(rig.driver.capabilities().peak_force_n == kFalconPeak_n);
  for (const Plugged& p :
       {Plugged{"LEFT", 10'000.0, 2.0}, Plugged{"RIGHT", 20'000.0, 2.0}, Plugged{"NEW", kFalconUncalibratedScale, 1.0},
        Plugged{"", kFalconUncalibratedScale, 1.0}, Plugged{"LEFT", 10'000.0, 2.0}}) {
    CAPTURE(std::string(p.serial));
    rig.model.serial = p.serial;
    rig.model.counts_per_nm = p.true_scale;
    rig.gate.stop();
    rig.plug_in();
    rig.tick();  // the servo sees that it is another one
    CHECK(rig.driver.calibrated() == (p.felt_n > 1.0));
    rig.make_ready();
    rig.push({0.0, 0.0, 2.0}, 900);
    const double felt = rig.model.hand_n_per_m * size_of(rig.model.place_m() - rig.model.hand_m);
    CHECK(felt == approx(p.felt_n).epsilon(0.02));
    CHECK(size_of(rig.sample.force_n) == approx(p.felt_n).epsilon(1e-9));
    rig.unplug();
    rig.tick();
  }
}

TEST_CASE("Falcon: a torque scale that is given counts, whatever is kept") {
  FalconOptions options = calibrated(8'000.0);
  options.kept["F00001"] = {20'000.0, "", ""};
  FalconRig rig(options);
  rig.model.counts_per_nm = 8'000.0;
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 2.0}, 900);
  const double felt = rig.model.hand_n_per_m * size_of(rig.model.place_m() - rig.model.hand_m);
  CHECK(felt == approx(2.0).epsilon(0.02));
}

TEST_CASE("Falcon: the force that it says is the one that is sent, also in the tick in which none is") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  REQUIRE(rig.pushes());
  rig.model.fault = FalconFault::garbage;
  rig.tick();
  rig.model.fault = FalconFault::none;
  CHECK(rig.sample.force_n == Vec3(0.0));
  CHECK(rig.model.last.torque == FalconCommand{}.torque);
  CHECK(rig.sample.state == DeviceState::ready);
}

TEST_CASE("Falcon: two commands in a row without an answer are a device that is gone, however soon, and one is none") {
  for (const bool stalled : {false, true}) {  // neither taken, or only not answered
    CAPTURE(stalled);
    FalconRig rig(calibrated());
    rig.plug_in();
    rig.make_ready();
    rig.push({0.0, 0.0, 1.0});
    rig.model.fault = FalconFault::silent;
    rig.takes_transfers = !stalled;
    const std::uint64_t lost = rig.driver.line().lost();
    int ticks = 0;
    for (; rig.sample.state == DeviceState::ready && ticks < 100; ++ticks) {
      CHECK(rig.driver.line().lost() - lost < 2);
      rig.tick();
    }
    CHECK(rig.sample.fault == DeviceFault::disconnected);
    CHECK(ticks <= 8);
    rig.model.fault = FalconFault::none;
    rig.takes_transfers = true;
    rig.tick(DeviceRequest::clear_fault);
    rig.make_ready();
  }
}

TEST_CASE("Falcon: counts are clamped long before they wrap, all three alike, whatever the force") {
  const Vec3 places[]{Vec3(0.0), Vec3(0.035, -0.035, 0.035), Vec3(-0.04, 0.0, -0.04)};
  for (const Vec3& place : places) {
    for (const double newtons : {0.5, 30.0, 1e3, 1e6, 1e300}) {
      for (const Vec3& way : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, -1.0), Vec3(0.6, -0.8, 0.0)}) {
        double share = 0.0;
        const auto counts = falcon_counts(place, newtons * way, 90'000.0, kFalconMostCounts, share);
        for (const int count : counts) CHECK(std::abs(count) <= kFalconMostCounts);
        CHECK(share >= 0.0);
        CHECK(share <= 1.0);
        const Vec3 torques = -1.0 / 90'000.0 * Vec3(counts[0], counts[1], counts[2]);
        const auto felt = falcon_force(place + kFalconCentre_m, torques);
        REQUIRE(felt);
        if (newtons > 1e4 || newtons < 1.0) continue;  // not finite in between, or rounded
        CHECK(glm::dot(*felt, way) / size_of(*felt) > 0.999);
      }
    }
  }
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    double share = 1.0;
    CHECK(falcon_counts(Vec3(0.0), Vec3(bad, 0.0, 0.0), 1e4, 4095, share) == std::array<std::int16_t, 3>{});
    CHECK(share == 0.0);
  }
}

TEST_CASE("Falcon: a force that is not finite is a bad command, and nothing is sent") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0}, 300);
  REQUIRE(rig.model.pushes());
  const ForceSample sample = rig.driver.exchange({.force_n = Vec3(std::nan(""))}, rig.now_ns);
  CHECK(sample.state == DeviceState::faulted);
  CHECK(sample.fault == DeviceFault::bad_command);
  CHECK(sample.force_n == Vec3(0.0));
  rig.tick();
  rig.tick();
  CHECK_FALSE(rig.model.pushes());
}

TEST_CASE("Falcon: a single packet lost or spoilt costs one command without torque, and no fault") {
  for (const FalconFault fault : {FalconFault::silent, FalconFault::garbage, FalconFault::cut}) {
    CAPTURE(static_cast<int>(fault));
    FalconRig rig(calibrated());
    rig.plug_in();
    rig.make_ready();
    rig.push({0.0, 0.0, 1.0});
    REQUIRE(rig.pushes());
    rig.model.fault = fault;
    rig.tick();
    rig.model.fault = FalconFault::none;
    int without = 0;
    for (int i = 0; i < 30; ++i) {
      rig.tick();
      without += !rig.pushes();
    }
    CHECK(rig.sample.state == DeviceState::ready);
    CHECK(rig.gate.state() == GateState::armed);
    CHECK(rig.pushes());
    CHECK(without <= 3);
  }
}

TEST_CASE("Falcon: when the servo stops calling, the link takes the force back by itself") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  REQUIRE(rig.pushes());
  rig.servo_runs = false;
  int ticks = 0;
  for (; rig.pushes() && ticks < 1000; ++ticks) rig.tick();
  CHECK(ticks <= 22);
  CHECK(ticks > 5);  // not at once: a late tick is none of this
}

TEST_CASE("Falcon: an emergency stop goes out before anything queued, and holds until a person clears it") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  REQUIRE(rig.pushes());
  rig.servo_runs = false;  // it hangs
  rig.driver.stop();
  rig.tick();
  CHECK_FALSE(rig.model.pushes());
  rig.servo_runs = true;
  rig.tick();
  CHECK(rig.sample.state == DeviceState::faulted);
  CHECK(rig.sample.fault == DeviceFault::watchdog);
  for (int i = 0; i < 100; ++i) {
    rig.tick();
    CHECK_FALSE(rig.model.pushes());
  }
  rig.tick(DeviceRequest::clear_fault);
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  CHECK(rig.pushes());
}

TEST_CASE("Falcon: an answer that comes while the servo reads its clock is no sample from the future") {
  static FalconRig* racing = nullptr;
  FalconRig rig(calibrated());
  racing = &rig;
  rig.plug_in();
  rig.make_ready();
  // As long after the clock is read as a thread may stand still.
  const auto now_ns = []() noexcept {
    const std::int64_t read_ns = racing->now_ns;
    racing->now_ns += 5'000'000;
    racing->model.tick();
    for (const Bytes& packet : racing->model.in_packets) racing->driver.line().packet(packet, racing->now_ns);
    racing->model.in_packets.clear();
    return read_ns;
  };
  for (int i = 0; i < 10; ++i) {
    const std::uint64_t answers = rig.driver.line().answers();
    const ForceSample sample = rig.driver.exchange({}, now_ns);
    CHECK(rig.driver.line().answers() > answers);
    CHECK(sample.age_s >= 0.0);
    CHECK(sample.state == DeviceState::ready);
    rig.tick();
  }
}

TEST_CASE("Falcon: a torque from before it was unplugged is not sent to the one that is plugged in") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  FalconLine& line = rig.driver.line();
  const std::uint32_t before = line.connection();
  rig.servo_runs = false;  // it stands still in its exchange
  rig.unplug();
  rig.plug_in();
  for (int i = 0; i < 1000 && line.phase() != FalconPhase::running; ++i) rig.tick();
  REQUIRE(line.phase() == FalconPhase::running);
  const FalconCommand push{.torque = {500, 500, 500}};
  line.post(push, before);  // and goes on
  for (int i = 0; i < 5; ++i) rig.tick();
  CHECK(rig.model.last.torque == FalconCommand{}.torque);
  line.post(push, line.connection());
  rig.tick();
  CHECK(rig.model.last.torque == push.torque);
}

TEST_CASE("Falcon: a torque that could not be sent for long is not sent any more") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  for (int i = 0; i < 5; ++i) rig.tick();
  rig.servo_runs = false;
  for (int i = 0; i < 5; ++i) rig.tick();
  rig.takes_transfers = false;
  rig.driver.line().post({.torque = {500, 500, 500}}, rig.driver.line().connection());
  for (int i = 0; i < 30; ++i) rig.tick();
  rig.takes_transfers = true;
  const std::uint64_t commands = rig.model.commands;
  for (int i = 0; i < 10; ++i) {
    rig.tick();
    CHECK_FALSE(rig.model.pushes());
  }
  CHECK(rig.model.commands > commands);
}

TEST_CASE("Falcon: the last command of a session is none, its lamps off") {
  FalconRig rig(calibrated());
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  REQUIRE(rig.pushes());
  rig.driver.line().end();
  rig.servo_runs = false;
  rig.tick();
  CHECK_FALSE(rig.model.pushes());
  CHECK(rig.model.last.lamps == 0);
  CHECK_FALSE(rig.model.last.homing);
  const auto commands = rig.model.commands;
  for (int i = 0; i < 20; ++i) rig.tick();
  CHECK(rig.model.commands == commands);
}

TEST_CASE("Falcon: plugged out and in again in the middle of a push it has to be homed, and goes on") {
  FalconRig rig(calibrated());
  for (int round = 0; round < 5; ++round) {
    rig.plug_in();
    rig.make_ready();
    rig.push({0.0, 0.0, 1.0});
    CHECK(rig.pushes());
    rig.unplug();
    rig.tick();
    CHECK(rig.sample.state == DeviceState::absent);
    CHECK(rig.sample.force_n == Vec3(0.0));
    for (int i = 0; i < 10; ++i) rig.tick();
    CHECK(rig.gate.state() == GateState::faulted);
  }
  CHECK(rig.model.pushed_unhomed == 0);
}

TEST_CASE(
    "Falcon: its motors without power for a while, it loads its firmware again after a person cleared the fault") {
  const Bytes firmware = falcon_firmware_of(500);
  FalconRig rig(calibrated(), firmware);
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  rig.model.running = false;
  REQUIRE(rig.reach(DeviceState::faulted, 50));
  for (int i = 0; i < 200; ++i) rig.tick();
  rig.tick(DeviceRequest::clear_fault);
  for (int i = 0; i < 3000 && rig.model.uploads == 0; ++i) rig.tick();
  CHECK(rig.model.uploads == 1);
  for (int i = 0; i < 3000 && !rig.model.running; ++i) rig.tick();
  for (int i = 0; i < 500; ++i) rig.tick();
  rig.tick(DeviceRequest::clear_fault);
  rig.make_ready();
}
