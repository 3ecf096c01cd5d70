// The Maestro driver against an emulated Maestro behind the real libusb.
#include "devices/maestro/maestro_display.h"

#include "core/lab/objects/generate.h"
#include "tests/devices/usb/emulation/maestro_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "workbench/session/maestro_setups.h"
#include "workbench/session/session.h"

#include <algorithm>
#include <ctime>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::emulation;

namespace {

constexpr double kTick_s = 1e-3;

struct MaestroBench {
  Testbed testbed;
  MaestroModel model;
  PluggedDevice device{testbed, model, 7};
  MaestroDisplay display;
  DisplaySample sample;

  MaestroBench() : display({.channel = 0, .speed = 120, .acceleration = 9, .settle_s = 0.05}) {
    device.plug_in();
    REQUIRE(display.open());
  }
  ~MaestroBench() { display.close(); }
  const DisplaySample& exchange(double target = 0.0, DeviceRequest request = DeviceRequest::none) {
    return sample = display.exchange({.target_m = target, .request = request}, kTick_s);
  }
  bool reach(DeviceState state) {
    return eventually([&] { return exchange().state == state; });
  }
  void make_ready() {
    REQUIRE(reach(DeviceState::firmware));
    exchange(0.0, DeviceRequest::home);
    REQUIRE(reach(DeviceState::ready));
  }
  template <class F>
  auto seen(F&& f) {
    return device.board.with_model(f);
  }
};

}  // namespace

TEST_CASE(
    "the Maestro gets speed and acceleration, goes to the middle, and follows its target in quarter microseconds") {
  MaestroBench b;
  b.make_ready();
  CHECK(b.seen([&] { return b.model.speeds[0]; }) == 120);
  CHECK(b.seen([&] { return b.model.accelerations[0]; }) == 9);
  CHECK(eventually([&] { return b.seen([&] { return b.model.targets[0]; }) == 6000; }));
  CHECK(eventually([&] {
    b.exchange(5e-3);
    return b.seen([&] { return b.model.targets[0]; }) == 7000;
  }));
  CHECK(b.sample.position_m == approx(5e-3));
  CHECK_FALSE(b.display.capabilities().measures_position);
  CHECK(b.display.capabilities().firmware_timeout_s == 0.0);  // stated: it has none
  b.exchange(0.0, DeviceRequest::stop);
  CHECK(eventually([&] {
    b.exchange();
    return b.seen([&] { return b.model.targets[0]; }) == 0;
  }));  // off
}

TEST_CASE("10,000 ticks: the Maestro's targets come in order, and the last one arrives") {
  MaestroBench b;
  b.make_ready();
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  for (int i = 1; i <= 10'000; ++i) {
    REQUIRE(b.exchange(9e-3 * i / 10'000.0).state == DeviceState::ready);
    if (i % 4 != 0) continue;  // 4 kHz on average: faster than the bus, so that some are skipped
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) {
      due.tv_nsec -= 1'000'000'000;
      ++due.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
  }
  const std::uint16_t last = quarter_us_at({}, 9e-3);
  REQUIRE(eventually([&] { return b.seen([&] { return b.model.targets[0]; }) == last; }));
  b.seen([&] {
    CHECK(std::is_sorted(b.model.history.begin(), b.model.history.end()));
    return 0;
  });
}

TEST_CASE("an emergency stop switches the Maestro's servo off without an exchange, and it stays off") {
  MaestroBench b;
  b.make_ready();
  b.exchange(5e-3);
  REQUIRE(eventually([&] { return b.seen([&] { return b.model.targets[0]; }) == 7000; }));
  CHECK(b.display.emergency_stop());
  CHECK(eventually([&] { return b.seen([&] { return b.model.targets[0]; }) == 0; }));
  CHECK(b.exchange(5e-3).state == DeviceState::faulted);
  for (int i = 0; i < 50; ++i) b.exchange(5e-3);
  CHECK(b.seen([&] { return b.model.targets[0]; }) == 0);
}

TEST_CASE("a session with a Maestro, whose firmware has no time-out, arms nothing before a person has said yes") {
  Testbed testbed;
  MaestroModel model;
  PluggedDevice device{testbed, model, 7};
  device.plug_in();
  SessionOptions options;
  options.threaded = false;
  options.devices.display = "maestro";
  auto scene = ContactScene::build(std::move(*ContactMesh::build(make_icosphere(0.040, 3))));
  REQUIRE(scene);
  auto session = Session::create(*scene, Preset{}, options);
  REQUIRE(session);
  CHECK((*session)->without_timeout() == std::vector<std::string>{"Pololu Maestro"});
  CHECK((*session)->needs_yes());
  const auto armed = [&] {
    (*session)->advance(20);
    const GateState state = (*session)->status().servo.gate_state;
    return state == GateState::armed || state == GateState::ramping;
  };
  (*session)->start();
  (*session)->arm();
  for (int i = 0; i < 50; ++i) CHECK_FALSE(armed());
  (*session)->accept_no_timeout();
  CHECK_FALSE((*session)->needs_yes());
  CHECK_FALSE(armed());
  (*session)->arm();
  CHECK(eventually(armed));
}

TEST_CASE("a Maestro that is unplugged is absent, one that refuses every request is faulted, and both come back") {
  MaestroBench b;
  b.make_ready();
  b.device.unplug();
  REQUIRE(b.reach(DeviceState::absent));
  b.device.plug_in();
  b.make_ready();
  b.seen([&] {
    b.model.stalls = true;
    return 0;
  });
  REQUIRE(b.reach(DeviceState::faulted));
  CHECK(b.sample.fault == DeviceFault::disconnected);
  LinkReport r;
  b.display.report(r);
  CHECK(r.stalls >= 3);
  b.seen([&] {
    b.model.stalls = false;
    return 0;
  });
  b.exchange(0.0, DeviceRequest::clear_fault);
  CHECK(eventually([&] {
    b.exchange();
    return b.sample.state == DeviceState::firmware;
  }));
}

TEST_CASE("a Maestro's calibration is kept by the serial number that it says on the bus") {
  Testbed testbed;
  MaestroModel model;
  model.serial = "00071234";
  const testing::TempFolder folder;
  const auto file = folder.path() / "maestro.toml";
  const MaestroSetup own{{-9e-3, 1100.0, 9e-3, 1900.0}, 2};
  CHECK(attached_maestro().empty());
  PluggedDevice device{testbed, model, 7};
  device.plug_in();
  REQUIRE(attached_maestro() == "00071234");
  CHECK(chosen_maestro_setup({}, file).value() == MaestroSetup{});
  REQUIRE(keep_maestro_setup(file, attached_maestro(), own));
  CHECK(chosen_maestro_setup({}, file).value() == own);
  MaestroWish wish;
  wish.channel = 0;  // the program's own, but asked for: the pulses that are kept stay
  CHECK(chosen_maestro_setup(wish, file).value() == MaestroSetup{own.calibration, 0});
  folder.write("maestro.toml", "[\"00071234\"]\nchannel = 99\n");
  CHECK_FALSE(chosen_maestro_setup({}, file).has_value());          // rather nothing than pulses that nobody meant
  CHECK(chosen_maestro_setup(wish_for(own), file).value() == own);  // but for who says it all
}
