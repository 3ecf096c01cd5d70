#include "devices/openhaptics/hd_force_device.h"

#include "devices/openhaptics/hd_errors.h"
#include "tests/devices/openhaptics/hd_stub_loader.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <limits>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kNaN_hd = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("openhaptics: calibrated, it is ready after a few frames, and says what the library says of it") {
  HdLoop l;
  REQUIRE(l.start());
  const ForceCapabilities& can = l.device.capabilities();
  CHECK(can.name == "Touch");
  CHECK(can.serial == "TOUCH-7");
  CHECK_FALSE(can.simulated);
  CHECK(can.peak_force_n == 3.3);
  CHECK(can.continuous_force_n == 0.88);
  CHECK(can.largest_stiffness_n_per_m == approx(1000.0));
  CHECK(can.rotations_sensed() == 3);
  CHECK(can.buttons == 2);
  CHECK(can.homing_s == 0.0);
  CHECK(can.firmware_timeout_s == 0.0);  // nobody has published one
  CHECK(glm::length(can.workspace_half_size_m - Vec3(0.08, 0.06, 0.035)) < 1e-12);
  std::vector<DeviceState> states;
  for (int i = 0; i < 10; ++i) {
    l.step();
    if (states.empty() || states.back() != l.loop.state()) states.push_back(l.loop.state());
  }
  CHECK(states == std::vector{DeviceState::open, DeviceState::firmware, DeviceState::homing, DeviceState::ready});
  CHECK(l.hd.broken_rules == 0);
  CHECK(l.felt_n() == 0.0);  // not armed
}

TEST_CASE("openhaptics: millimetres and its axes become the device's frame, and the world's") {
  HdLoop l;
  l.hd.position_mm[0] = 10.0;  // right
  l.hd.position_mm[1] = 50.0;  // up; the middle of the workspace is at 30
  l.hd.position_mm[2] = 25.0;  // to the person; the middle is at -5
  l.hd.velocity_mm_per_s[2] = 200.0;
  l.hd.buttons = 3;
  REQUIRE(l.start());
  l.step(20);
  REQUIRE(l.loop.state() == DeviceState::ready);
  const Vec3 at = l.loop.sample().position_m;
  CHECK(glm::length(at - Vec3(0.010, 0.020, 0.030)) < 1e-12);
  CHECK(glm::length(*l.loop.sample().velocity_m_per_s - Vec3(0.0, 0.0, 0.2)) < 1e-12);
  CHECK(l.loop.sample().buttons == 3);
  const Quat to_world = l.device.capabilities().frame.rotation;
  CHECK(glm::length(to_world * at - Vec3(-0.030, -0.010, 0.020)) < 1e-12);  // towards the person, right, up
  CHECK(glm::length(to_world * l.loop.sample().orientation * Vec3(1, 0, 0) - Vec3(1, 0, 0)) < 1e-12);  // points away
  l.loop.wanted_n = Vec3(0.1, 0.2, 0.3);
  l.push();
  CHECK(l.hd.force_n[0] == approx(0.1));
  CHECK(l.hd.force_n[1] == approx(0.2));
  CHECK(l.hd.force_n[2] == approx(0.3));
}

TEST_CASE("openhaptics: a stylus that is turned turns the finger about the same axis of the world") {
  // Column after column: a quarter turn about the device's y (up), which takes its z to its x.
  const double quarter[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1};
  REQUIRE(hd::is_rotation(quarter));
  const Quat world = hd::device_frame().rotation * hd::orientation(quarter);
  // To the left about up: what pointed away (-z) points left (-x of the device, +y of the world).
  CHECK(glm::length(world * Vec3(1, 0, 0) - Vec3(0, 1, 0)) < 1e-12);
  CHECK(glm::length(world * Vec3(0, 0, 1) - Vec3(0, 0, 1)) < 1e-12);
  const double sheared[16] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const double mirrored[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  CHECK_FALSE(hd::is_rotation(sheared));
  CHECK_FALSE(hd::is_rotation(mirrored));
}

TEST_CASE("openhaptics: it is calibrated in the inkwell, by itself, and pushes with nothing before") {
  HdLoop l;
  l.hd.calibration = 0x5002;  // put it into the inkwell
  l.hd.calibrates_when_told = true;
  REQUIRE(l.start());
  l.loop.arm();
  l.step(50);
  CHECK(l.loop.state() == DeviceState::firmware);
  CHECK(l.felt_n() == 0.0);
  LinkReport said;
  REQUIRE(l.device.report(said));
  CHECK(said.problem == "Touch: is not calibrated; put the stylus into the inkwell, for a second");
  l.hd.calibration = 0x5001;  // there it is
  l.step(400);
  CHECK(l.hd.calibrated_with == hd::kInkwell);
  CHECK(l.loop.state() == DeviceState::ready);
  CHECK(l.felt_n() == approx(0.5));
  CHECK(l.hd.broken_rules == 0);
  CHECK_MESSAGE(l.hd.first_broken.empty(), l.hd.first_broken);
}

TEST_CASE("openhaptics: encoders are reset only when a person said that they lie at their place") {
  HdOptions options = stub_hd_options();
  options.reset_encoders = true;
  HdLoop told(options);
  told.hd.styles = 1;
  REQUIRE(told.start());
  CHECK(told.hd.calibrated_with == hd::kEncoderReset);
  told.device.close();

  HdLoop untold;
  untold.hd.styles = 1;
  untold.hd.calibration = 0x5001;
  REQUIRE(untold.start());
  untold.step(50);
  CHECK(untold.hd.calibrated_with == 0);
  CHECK(untold.loop.state() == DeviceState::firmware);
}

TEST_CASE("openhaptics: the calls come in the order that the guide asks for, closing in contact included") {
  HdOptions options = stub_hd_options();
  options.last_frame_s = 60.0;  // ended by the last frame
  HdLoop l(options);
  l.hd.own_thread = true;
  REQUIRE(l.start());
  l.loop.arm();
  wait_until([&] { return l.loop.ticks > 300; });
  l.device.close();
  const std::vector<std::string> log = l.hd.log();
  CHECK(happened_in_order(log, {"init", "enable force", "rate 1000", "schedule", "start", "force", "zero force", "stop",
                                "unschedule", "disable force", "disable device"}));
  CHECK(std::count(log.begin(), log.end(), "stop") == 1);
  CHECK(l.felt_n() == 0.0);
  CHECK(l.hd.broken_rules == 0);
  CHECK_MESSAGE(l.hd.first_broken.empty(), l.hd.first_broken);
  CHECK(l.loop.ticks <= static_cast<std::uint64_t>(l.hd.frames.load()));  // and the last frames of zero force
}

TEST_CASE("openhaptics: unplugged and plugged in again it comes back, the program running on") {
  HdLoop l;
  REQUIRE(l.start());
  l.push();
  CHECK(l.felt_n() == approx(0.5));
  l.hd.unplugged = true;
  l.step();
  CHECK(l.loop.first_fault() == DeviceFault::disconnected);
  CHECK(l.felt_n() == 0.0);
  LinkReport said;
  // The keeper stops the scheduler and calls the tick itself.
  const std::uint64_t before = l.loop.ticks;
  wait_until([&] { return l.loop.ticks > before + 3; });
  REQUIRE(l.device.report(said));
  CHECK_FALSE(said.connected);
  CHECK(said.problem.find("the device does not answer (HD_COMM_ERROR, 0x0302)") != std::string::npos);
  l.hd.unplugged = false;
  wait_until([&] { return l.device.report(said) && said.connected; });
  CHECK(said.connects == 2);
  l.step(20);
  CHECK(l.loop.state() == DeviceState::ready);
  CHECK(l.felt_n() == 0.0);  // until a person arms
  l.push();
  CHECK(l.felt_n() == approx(0.5));
  CHECK(l.hd.broken_rules == 0);
}

TEST_CASE("openhaptics: a scheduler that calls no more is stopped, the force disabled, and started again") {
  HdOptions options = stub_hd_options();
  options.silence_s = 0.05;
  HdLoop l(options);
  l.hd.own_thread = true;
  REQUIRE(l.start());
  wait_until([&] { return l.loop.ticks > 20; });
  l.hd.silent = true;
  LinkReport said;
  wait_until([&] {
    const auto log = l.hd.log();
    return happened_in_order(log, {"start", "disable force", "stop", "unschedule", "disable device", "init", "start"});
  });
  l.hd.silent = false;
  const int frames = l.hd.frames;
  wait_until([&] { return l.hd.frames > frames + 20; });
  l.device.close();
  REQUIRE(l.device.report(said));
  CHECK(said.connects >= 2);
  CHECK(l.hd.broken_rules == 0);
}

TEST_CASE("openhaptics: an emergency disables the force and stops the scheduler, from any thread") {
  HdLoop l;
  REQUIRE(l.start());
  l.push();
  CHECK(l.device.emergency_stop());
  wait_until([&] { return happened_in_order(l.hd.log(), {"force", "disable force", "stop", "disable device"}); });
  LinkReport said;
  wait_until([&] { return l.device.report(said) && said.connects == 2; });
  l.step(20);
  CHECK(l.loop.state() == DeviceState::ready);
  CHECK(l.felt_n() == 0.0);
}

TEST_CASE("openhaptics: after an emergency the very next frame has no force, however late its keeper is") {
  HdLoop l;
  REQUIRE(l.start());
  l.push();
  REQUIRE(l.felt_n() > 0.4);
  CHECK(l.device.emergency_stop());
  l.step();
  CHECK((l.felt_n() == 0.0 || happened_in_order(l.hd.log(), {"force", "disable force"})));  // unless it was first
}

TEST_CASE("openhaptics: a call that comes after calling was stopped is no tick, and sends no force") {
  HdLoop l;
  l.hd.calls_late = true;
  REQUIRE(l.start());
  l.push();
  REQUIRE(l.felt_n() > 0.4);
  l.device.stop_calling();
  const std::uint64_t ticks = l.loop.ticks;
  l.step(3);
  CHECK(l.loop.ticks == ticks);
  CHECK(l.felt_n() == 0.0);
}

TEST_CASE("openhaptics: where the library states no workspace, no position is believed that no device has") {
  HdLoop l;
  for (double& corner : l.hd.reach_mm) corner = 0.0;
  for (double& corner : l.hd.usable_mm) corner = 0.0;
  REQUIRE(l.start());
  l.push();
  REQUIRE(l.loop.state() == DeviceState::ready);
  l.hd.position_mm[1] = 1e9;
  l.step();
  CHECK(l.loop.state() == DeviceState::faulted);
  CHECK(l.loop.first_fault() == DeviceFault::sensor);
  CHECK(l.felt_n() == 0.0);
}

TEST_CASE("openhaptics: every error code of the guide stops the force in its tick, and is told with what to do") {
  for (const unsigned code : {0x100u, 0x101u, 0x102u, 0x103u, 0x104u, 0x200u, 0x201u, 0x202u, 0x203u, 0x204u, 0x300u,
                              0x301u, 0x302u, 0x303u, 0x304u, 0x400u, 0x401u, 0x402u, 0x500u, 0x501u, 0x600u, 0x777u}) {
    CAPTURE(code);
    HdOptions options = stub_hd_options();
    options.reopen_s = 1e6;
    HdLoop l(options);
    REQUIRE(l.start());
    l.push();
    REQUIRE(l.felt_n() > 0.4);
    l.hd.frame_error = code;
    l.step();
    CHECK(l.felt_n() == 0.0);
    CHECK(l.loop.noticed());
    CHECK(l.loop.first_fault() == hd::explain(code).fault);
    LinkReport said;
    REQUIRE(l.device.report(said));
    const hd::Explained& known = hd::explain(code);
    CHECK(said.problem.find(known.what) != std::string::npos);
    CHECK(said.problem.find(known.name) != std::string::npos);
    CHECK(std::string(known.remedy).size() > 5);
    if (hd::explain(code).fault == DeviceFault::disconnected) continue;
    l.hd.frame_error = 0;
    l.step(5);
    CHECK(l.loop.state() == DeviceState::faulted);  // until a person clears it
    l.loop.ask(DeviceRequest::clear_fault);
    l.step(20);
    CHECK(l.loop.state() == DeviceState::ready);
    CHECK(l.felt_n() == 0.0);
    said = {};
    REQUIRE(l.device.report(said));
    CHECK(said.problem.empty());
  }
}

TEST_CASE("openhaptics: a command that is no number is not sent") {
  HdLoop l;
  REQUIRE(l.start());
  l.step(20);
  struct Bad {
    HdForceDevice& device;
    ForceSample sample;
    static void run(void* bad) noexcept {
      auto& me = *static_cast<Bad*>(bad);
      me.sample = me.device.exchange({.force_n = Vec3(kNaN_hd, 0.0, 0.0)}, 1e-3);
    }
  } bad{l.device, {}};
  l.device.stop_calling();
  REQUIRE(l.device.start_calling({Bad::run, &bad}));
  l.step(20);
  CHECK(bad.sample.fault == DeviceFault::bad_command);
  CHECK(l.felt_n() == 0.0);
}

TEST_CASE("openhaptics: what keeps it from opening is told with what to do") {
  HdOptions options = stub_hd_options();
  const auto refused = [](const HdOptions& with) {
    HdForceDevice device(with);
    const Status opened = device.open();
    return opened ? Error{} : opened.error();
  };
  options.library = "/nowhere/libHD.so";
  const Error missing = refused(options);
  CHECK(missing.where == "/nowhere/libHD.so");
  CHECK(missing.what.find("can't be loaded: ") == 0);
  CHECK(missing.remedy.find("--hd-library says where it is") != std::string::npos);

  options.library = testing::lacking_hd();
  CHECK(refused(options).what == "lacks hdEndFrame, hdUnschedule");

  options.library = testing::stub_hd();
  fresh_stub_hd().version = "2.0.3";
  CHECK(refused(options).what == "its version is 2.0.3, and 3 or newer is needed");

  fresh_stub_hd().init_error = 0x0302;
  const Error unplugged = refused(options);
  CHECK(unplugged.where == "OpenHaptics' default device");
  CHECK(unplugged.remedy.find("ls -l /dev/ttyACM*") != std::string::npos);

  fresh_stub_hd().max_force_n = -1.0;  // it lies: then none is sent
  HdForceDevice lies(options);
  REQUIRE(lies.open());
  CHECK(lies.capabilities().peak_force_n == 0.0);
  HdForceDevice second(options);
  const Status twice = second.open();
  REQUIRE_FALSE(twice);
  CHECK(twice.error().what.find("this program uses one already") == 0);
  lies.close();
  CHECK(second.open());
  CHECK_FALSE(second.open());
}

TEST_CASE("openhaptics: of several that are set up one is chosen by its name, or they are listed") {
  const auto folder = std::filesystem::temp_directory_path() / ("tangent_hd_setups_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (const char* name : {"Left Device.config", "Default Device.config", "notes.txt"})
    static_cast<void>(fclose(fopen((folder / name).c_str(), "w")));
  HdOptions options = stub_hd_options();
  options.configs = folder;
  fresh_stub_hd();
  {
    HdForceDevice either(options);
    const Status refused = either.open();
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what == "several are set up: \"Default Device\", \"Left Device\"");
    CHECK(refused.error().remedy == "choose one: --hd-device NAME");
  }
  options.device = "Left Device";
  HdForceDevice left(options);
  CHECK_FALSE(left.open());  // the stub has no such one
  loaded_stub_hd().name = "Left Device";
  REQUIRE(left.open());
  CHECK(happened_in_order(loaded_stub_hd().log(), {"init Left Device"}));
  std::filesystem::remove_all(folder);
}

TEST_CASE("openhaptics: another device in the place of a lost one is not taken for it") {
  HdLoop l;
  REQUIRE(l.start());
  l.step(20);
  l.hd.unplugged = true;
  l.step();
  LinkReport said;
  wait_until([&] { return l.device.report(said) && !said.connected; });
  l.hd.serial = "TOUCH-8";
  l.hd.unplugged = false;
  const auto tries = [&] {
    const auto log = l.hd.log();
    return std::count(log.begin(), log.end(), "init");
  };
  const auto before = tries();
  wait_until([&] { return tries() > before + 2; });
  REQUIRE(l.device.report(said));
  CHECK_FALSE(said.connected);
}
