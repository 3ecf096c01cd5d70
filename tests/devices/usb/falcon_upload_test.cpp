// Loading the Falcon's firmware, step by step, with everything that goes wrong on the way.
#include "tests/devices/usb/falcon_rig.h"

using namespace tangent;
using namespace tangent::emulation;

namespace {

constexpr std::size_t kFirmwareBytes = 1500;  // 24 pieces of 62 bytes and one of 12

struct UploadRig : FalconRig {
  explicit UploadRig(int attempts = 5) : FalconRig(options(attempts), falcon_firmware_of(kFirmwareBytes)) {
    model.running = false;
  }
  static FalconOptions options(int attempts) {
    FalconOptions o;
    o.line.attempts = attempts;
    return o;
  }
  bool loads() {
    plug_in();
    return reach(DeviceState::firmware, 20'000);
  }
};

}  // namespace

TEST_CASE("Falcon: without firmware it is loaded, once, and the chip is left as it has to be for packets") {
  for (const bool zero : {false, true}) {
    UploadRig rig;
    rig.model.leading_zero = zero;
    REQUIRE(rig.loads());
    CHECK(rig.model.uploads == 1);
    CHECK(rig.model.running);
    CHECK(rig.model.baud == 2);
    CHECK(rig.model.latency_ms == 1);
    CHECK(rig.driver.line().failed_step().empty());
  }
}

TEST_CASE("Falcon: a device that runs its firmware is used as it is") {
  FalconRig rig({}, falcon_firmware_of(kFirmwareBytes));
  rig.plug_in();
  REQUIRE(rig.reach(DeviceState::firmware));
  CHECK(rig.model.uploads == 0);
}

TEST_CASE("Falcon: one fault at any step costs an attempt, and the next one succeeds") {
  using F = UploadFault;
  for (const F::Kind kind : {F::silence, F::wrong_echo, F::missing_byte}) {
    for (const F& fault : {F{kind, F::greeting, 0}, F{kind, F::letter, 0}, F{kind, F::piece, 0}, F{kind, F::piece, 13},
                           F{kind, F::piece, 24}}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(static_cast<int>(fault.step));
      CAPTURE(fault.at_piece);
      UploadRig rig;
      rig.model.upload = fault;
      REQUIRE(rig.loads());
      CHECK(rig.model.running);
      CHECK(rig.driver.line().uploads() == (fault.step == F::greeting ? 1 : 2));  // the greeting is said again
    }
  }
}

TEST_CASE("Falcon: a step that goes wrong every time is named, the device faulted, and a person can try again") {
  using F = UploadFault;
  struct Case {
    F fault;
    const char* says;
  };
  constexpr int kAlways = 1000;
  for (const Case& c : {Case{{F::silence, F::greeting, 0, kAlways}, "the boot loader's greeting: no answer"},
                        Case{{F::wrong_echo, F::greeting, 0, kAlways}, "the boot loader's greeting: wrong answer"},
                        Case{{F::silence, F::letter, 0, kAlways}, "the letter A: no answer"},
                        Case{{F::wrong_echo, F::letter, 0, kAlways}, "the letter A: wrong answer"},
                        Case{{F::missing_byte, F::piece, 7, kAlways}, "the firmware, piece 8 of 25: no answer"},
                        Case{{F::wrong_echo, F::piece, 24, kAlways}, "the firmware, piece 25 of 25: wrong answer"}}) {
    UploadRig rig(3);
    rig.model.upload = c.fault;
    rig.plug_in();
    REQUIRE(rig.reach(DeviceState::faulted, 20'000));
    CHECK(rig.sample.fault == DeviceFault::firmware);
    CHECK(rig.driver.line().phase() == FalconPhase::not_loaded);
    CHECK(rig.driver.line().failed_step() == c.says);
    CHECK(rig.driver.line().uploads() == 3);
    rig.model.upload = {};
    rig.tick(DeviceRequest::clear_fault);
    REQUIRE(rig.reach(DeviceState::firmware, 20'000));
    CHECK(rig.driver.line().failed_step().empty());
  }
}

TEST_CASE("Falcon: transfers that fail are named by the step they belong to") {
  UploadRig rig;
  rig.takes_transfers = false;
  rig.plug_in();
  REQUIRE(rig.reach(DeviceState::faulted, 20'000));
  CHECK(rig.driver.line().failed_step() == "latency of 1 ms: the USB transfer failed");
}

TEST_CASE("Falcon: a firmware that loads and does not start is a fault, and so is an echo instead of an answer") {
  UploadRig rig(2);
  rig.model.firmware = {1, 2, 3};  // what it would start
  rig.plug_in();
  REQUIRE(rig.reach(DeviceState::faulted, 20'000));
  CHECK(rig.driver.line().phase() == FalconPhase::not_loaded);
  FalconRig echo;
  echo.model.running = false;
  echo.model.echoes = true;
  echo.plug_in();
  REQUIRE(echo.reach(DeviceState::faulted, 2000));
  CHECK(echo.driver.line().phase() == FalconPhase::no_firmware);
}

TEST_CASE(
    "Falcon: without firmware in the device or on the disk there is a fault, until one is plugged in that has it") {
  FalconRig rig;
  rig.model.running = false;
  rig.plug_in();
  REQUIRE(rig.reach(DeviceState::faulted, 2000));
  CHECK(rig.sample.fault == DeviceFault::firmware);
  rig.unplug();
  rig.tick();
  CHECK(rig.sample.state == DeviceState::absent);
  rig.model.running = true;
  rig.plug_in();
  CHECK(rig.reach(DeviceState::firmware));
}

TEST_CASE("Falcon: unplugged at any millisecond of the upload, it is loaded when it is plugged in again") {
  for (int at = 1; at < 900; at += 37) {
    UploadRig rig;
    rig.plug_in();
    for (int i = 0; i < at; ++i) rig.tick();
    rig.unplug();
    rig.tick();
    CHECK(rig.sample.state == DeviceState::absent);
    rig.model.running = false;
    REQUIRE(rig.loads());
    CHECK(rig.model.running);
  }
}
