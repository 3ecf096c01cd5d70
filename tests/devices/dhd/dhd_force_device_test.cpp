#include "devices/dhd/dhd_force_device.h"

#include "devices/dhd/dhd_errors.h"
#include "devices/dhd/dhd_models.h"
#include "tests/devices/dhd/dhd_stub_loader.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <limits>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("dhd: calibrated, it becomes ready, and says what is known of its type") {
  DhdLoop l;
  REQUIRE(l.start());
  const ForceCapabilities& can = l.device.capabilities();
  CHECK(can.name == "omega.3");
  CHECK(can.serial == "1234");
  CHECK_FALSE(can.simulated);
  CHECK(can.peak_force_n == 12.0);
  CHECK(can.continuous_force_n == 0.0);  // not known
  CHECK(can.workspace_half_size_m == Vec3(0.075));
  CHECK(can.rotations_sensed() == 0);
  CHECK(can.homing_s == 0.0);
  CHECK(can.firmware_timeout_s == approx(0.03));
  CHECK_FALSE(l.device.calls_us());
  std::vector<DeviceState> states;
  for (int i = 0; i < 6; ++i) {
    l.step();
    if (states.empty() || states.back() != l.loop.state()) states.push_back(l.loop.state());
  }
  CHECK(states == std::vector{DeviceState::open, DeviceState::firmware, DeviceState::homing, DeviceState::ready});
  CHECK(happened_in_order(l.dhd.log(), {"open 0", "enable force"}));
  CHECK(l.felt_n() == 0.0);  // not armed
}

TEST_CASE("dhd: metres and its axes become the device's frame, and the world's") {
  DhdLoop l;
  l.dhd.wrist = true;
  const double position_m[3] = {0.01, 0.02, 0.03}, velocity_m_per_s[3] = {0.1, 0.0, -0.2};
  std::copy_n(position_m, 3, l.dhd.position_m);
  std::copy_n(velocity_m_per_s, 3, l.dhd.velocity_m_per_s);
  l.dhd.buttons = 5;
  REQUIRE(l.start());
  CHECK(l.device.capabilities().rotations_sensed() == 3);
  l.step(10);
  const ForceSample sample = l.loop.sample();
  CHECK(sample.position_m == Vec3(0.01, 0.02, 0.03));
  CHECK(*sample.velocity_m_per_s == Vec3(0.1, 0.0, -0.2));
  CHECK(sample.buttons == 5);
  const Quat to_world = l.device.capabilities().frame.rotation;
  CHECK(glm::length(to_world * sample.position_m - Vec3(-0.01, -0.02, 0.03)) < 1e-12);  // to the person, right, up
  CHECK(glm::length(to_world * sample.orientation * Vec3(1, 0, 0) - Vec3(1, 0, 0)) < 1e-12);  // points away
  // A quarter turn about up, to the left: what points away then points left.
  const double quarter[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  REQUIRE(dhd::is_rotation(quarter));
  CHECK(glm::length(to_world * dhd::orientation(quarter) * Vec3(1, 0, 0) - Vec3(0, 1, 0)) < 1e-12);
  const double mirrored[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  CHECK_FALSE(dhd::is_rotation(mirrored));
  l.loop.wanted_n = Vec3(0.1, 0.2, 0.3);
  l.push();
  CHECK(l.dhd.force_n[0] == approx(0.1));
  CHECK(l.dhd.force_n[1] == approx(0.2));
  CHECK(l.dhd.force_n[2] == approx(0.3));
  const std::vector<std::string> log = l.dhd.log();
  CHECK(std::count(log.begin(), log.end(), "torque") == 0);
}

TEST_CASE("dhd: not calibrated it waits for the hand, and pushes with nothing") {
  DhdLoop l;
  l.dhd.calibrated = false;
  REQUIRE(l.start());
  l.push();
  CHECK(l.loop.state() == DeviceState::firmware);
  CHECK(l.felt_n() == 0.0);
  LinkReport said;
  REQUIRE(l.device.report(said));
  CHECK(said.problem.find("bring the handle to its rest position") != std::string::npos);
  l.dhd.calibrated = true;
  l.push();
  CHECK(l.loop.state() == DeviceState::ready);
  CHECK(l.felt_n() == approx(0.5));
}

TEST_CASE("dhd: closed in contact it sends zero force, stops, and only then closes") {
  DhdLoop l;
  REQUIRE(l.start());
  l.push();
  l.device.close();
  CHECK(happened_in_order(l.dhd.log(), {"open 0", "enable force", "force", "zero force", "stop", "close 0"}));
  CHECK(l.felt_n() == 0.0);
  const int forces = l.dhd.forces;
  l.step(3);
  CHECK(l.dhd.forces == forces);  // nothing is sent to a closed device
  CHECK(l.loop.state() == DeviceState::absent);
}

TEST_CASE("dhd: unplugged and plugged in again it comes back by its serial number, the program running on") {
  DhdLoop l;
  REQUIRE(l.start());
  l.push();
  CHECK(l.felt_n() == approx(0.5));
  l.dhd.unplugged = true;
  l.step();
  CHECK(l.felt_n() == 0.0);
  CHECK(l.loop.state() == DeviceState::faulted);
  CHECK(l.loop.first_fault() == DeviceFault::disconnected);
  LinkReport said;
  REQUIRE(l.device.report(said));
  CHECK_FALSE(said.connected);
  // The keeper may have looked for it already.
  const bool named = said.problem.find("the device does not answer (DHD_ERROR_COM, 2)") != std::string::npos ||
                     said.problem.find("no such device is found (DHD_ERROR_NO_DEVICE_FOUND, 5)") != std::string::npos;
  CHECK_MESSAGE(named, said.problem);
  l.step(3);
  CHECK(l.loop.state() == DeviceState::absent);
  l.dhd.unplugged = false;
  wait_until([&] { return l.device.report(said) && said.connected; });
  CHECK(happened_in_order(l.dhd.log(), {"force", "zero force", "stop", "close 0", "open serial 1234"}));
  l.step(20);
  CHECK(l.loop.state() == DeviceState::ready);
  CHECK(l.felt_n() == 0.0);  // until a person arms
  l.push();
  CHECK(l.felt_n() == approx(0.5));
}

TEST_CASE("dhd: an emergency stops the force, from any thread, and the device says so") {
  DhdLoop l;
  REQUIRE(l.start());
  l.push();
  CHECK(l.device.emergency_stop());
  wait_until([&] { return happened_in_order(l.dhd.log(), {"force", "stop"}); });
  l.step();
  CHECK(l.felt_n() == 0.0);
  LinkReport said;
  REQUIRE(l.device.report(said));
  CHECK(said.problem.find("DHD_FORCEOFF_SOFTWARE") != std::string::npos);
  l.loop.ask(DeviceRequest::clear_fault);
  l.step(10);
  CHECK(l.loop.state() == DeviceState::ready);
  CHECK(l.felt_n() == 0.0);
  said = {};
  REQUIRE(l.device.report(said));
  CHECK(said.problem.empty());
  wait_until([&] {  // the keeper may still be about to note that it has stopped it
    l.push();
    return l.felt_n() != 0.0;
  });
  CHECK(l.felt_n() == approx(0.5));
}

TEST_CASE("dhd: every error code of the reference stops the force in its tick, and is told with what to do") {
  for (int code = 1; code <= dhd::kErrors; ++code) {
    CAPTURE(code);
    DhdOptions options = stub_dhd_options();
    options.reopen_s = 1e6;
    DhdLoop l(options);
    REQUIRE(l.start());
    l.push();
    REQUIRE(l.felt_n() > 0.4);
    l.dhd.call_error = code;
    l.step();
    CHECK(l.felt_n() == 0.0);
    CHECK(l.loop.state() == DeviceState::faulted);
    const dhd::Explained& known = dhd::explain(code);
    CHECK(l.loop.first_fault() == known.fault);
    LinkReport said;
    REQUIRE(l.device.report(said));
    CHECK(said.problem.find(known.what) != std::string::npos);
    CHECK(said.problem.find(known.name) != std::string::npos);
    CHECK(std::string(known.remedy).size() > 5);
    if (known.fault == DeviceFault::disconnected) continue;
    l.dhd.call_error = 0;
    l.step(5);
    CHECK(l.loop.state() == DeviceState::faulted);  // until a person clears it
    l.loop.ask(DeviceRequest::clear_fault);
    l.step(10);
    CHECK(l.loop.state() == DeviceState::ready);
    CHECK(l.felt_n() == 0.0);
  }
}

TEST_CASE("dhd: every cause for switching its force off is told with what to do") {
  for (int cause = 0; cause < dhd::kForceOffCauses; ++cause) {
    CAPTURE(cause);
    DhdLoop l;
    REQUIRE(l.start());
    l.push();
    l.dhd.force_off_cause = cause;
    l.dhd.force_on = false;
    l.step();
    CHECK(l.felt_n() == 0.0);
    CHECK(l.loop.first_fault() == dhd::explain_force_off(cause).fault);
    LinkReport said;
    REQUIRE(l.device.report(said));
    CHECK(said.problem.find(dhd::explain_force_off(cause).name) != std::string::npos);
    CHECK(std::string(dhd::explain_force_off(cause).remedy).size() > 5);
  }
}

TEST_CASE("dhd: a command that is no number is not sent") {
  DhdLoop l;
  REQUIRE(l.start());
  l.step(10);
  const Vec3 none(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  CHECK(l.device.exchange({.force_n = none}, 1e-3).fault == DeviceFault::bad_command);
  CHECK(l.felt_n() == 0.0);
}

TEST_CASE("dhd: what keeps it from opening is told with what to do") {
  DhdOptions options = stub_dhd_options();
  const auto refused = [](const DhdOptions& with) {
    DhdForceDevice device(with);
    const Status opened = device.open();
    return opened ? Error{} : opened.error();
  };
  options.library = "/nowhere/libdhd.so";
  CHECK(refused(options).what.find("can't be loaded: ") == 0);
  CHECK(refused(options).remedy.find("--dhd-library says where it is") != std::string::npos);
  options.library = testing::lacking_dhd();
  CHECK(refused(options).what == "lacks dhdGetStatus");
  options.library = testing::stub_dhd();
  fresh_stub_dhd().minor = 2;
  CHECK(refused(options).what == "its version is 3.2, and 3.3 or newer is needed");
  fresh_stub_dhd().count = 0;
  CHECK(refused(options).remedy.find("lsusb -d 1451:") != std::string::npos);
  for (int code = 1; code < dhd::kErrors; ++code) {
    fresh_stub_dhd().open_error = code;
    CHECK(refused(options).what == dhd::to_error(code, "").what);
  }
}

TEST_CASE("dhd: of two one is chosen by its serial number, or both are listed") {
  DhdOptions options = stub_dhd_options();
  fresh_stub_dhd().count = 2;
  DhdForceDevice either(options);
  const Status refused = either.open();
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what == "several are attached: omega.3, serial 1234, sigma.7, serial 1235");
  CHECK(refused.error().remedy == "choose one: --dhd-serial NUMBER");
  const auto found = find_dhd_devices(options);
  REQUIRE(found);
  CHECK(found->size() == 2);
  options.serial = 1235;
  DhdForceDevice second(options);
  REQUIRE(second.open());
  CHECK(second.capabilities().name == "sigma.7");
  CHECK(second.capabilities().serial == "1235");
  options.serial = 9;
  CHECK_FALSE(DhdForceDevice(options).open());
}

TEST_CASE("dhd: of a type that is not known no force is sent, unless a person says its peak") {
  DhdOptions options = stub_dhd_options();
  fresh_stub_dhd().types[0] = 250;
  DhdForceDevice unknown(options);
  REQUIRE(unknown.open());
  CHECK(unknown.capabilities().name == "a new device");
  CHECK(unknown.capabilities().peak_force_n == 0.0);
  LinkReport report;
  unknown.report(report);
  CHECK(report.problem.find("it gets no force") != std::string::npos);
  CHECK(report.problem.find("--dhd-peak-n") != std::string::npos);
  unknown.close();
  options.peak_n = 9.0;
  DhdForceDevice told(options);
  REQUIRE(told.open());
  CHECK(told.capabilities().peak_force_n == 9.0);
}
