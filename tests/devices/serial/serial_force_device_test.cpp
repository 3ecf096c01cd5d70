// The driver over a pseudo-terminal, with the reference firmware and a mass at its other end.
#include "devices/serial/serial_force_device.h"

#include "tests/devices/serial/serial_faults.h"
#include "tests/support/approx.h"

#include <grp.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <cstdio>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::serial_test;

TEST_CASE("a force device on a serial line says what it is, is homed, and pushes") {
  SerialBench b;
  const ForceCapabilities& can = b.device.capabilities();
  CHECK(can.serial == "77");
  CHECK_FALSE(can.simulated);
  CHECK(can.pushes_along == std::array<bool, 3>{true, true, true});
  CHECK(can.senses_rotation == std::array<bool, 3>{true, true, true});
  CHECK(can.buttons == 2);
  CHECK(can.peak_force_n == approx(5.0));
  CHECK(can.continuous_force_n == approx(2.0));
  CHECK(can.position_resolution_m == approx(10e-6));
  CHECK(can.apparent_mass_kg == approx(0.1));
  CHECK(can.largest_stiffness_n_per_m == approx(2000.0));
  CHECK(can.largest_damping_n_s_per_m == approx(5.0));
  CHECK(can.workspace_half_size_m.y == approx(0.05));
  CHECK(can.rate_hz == approx(1000.0));
  CHECK(can.homing_s == approx(1.0));
  CHECK(can.firmware_timeout_s == approx(0.02));
  b.push();
  for (int i = 0; i < 300; ++i) b.tick();
  // 1 N on a hand of 200 N/m, as the firmware measures it, the newest of a tick ago.
  CHECK(b.sample.position_m.z == approx(5e-3).epsilon(1e-3));
  CHECK(b.sample.position_m.x == 0.0);
  CHECK(b.sample.age_s == approx(1e-3));
  b.rig.buttons = 1;
  b.tick();
  b.tick();
  CHECK(b.sample.buttons == 1);
  b.tick(DeviceRequest::stop);
  CHECK(b.rig.force_n == std::array<double, 3>{});
  CHECK(b.reach(DeviceState::firmware));
}

TEST_CASE("every fault of a serial line takes the force away within two ticks") {
  for (const SerialFault& fault : serial_faults()) {
    CAPTURE(fault.name);
    const SerialFaultTicks ticks = count_ticks(fault);
    CHECK(ticks.noticed >= 0);
    CHECK(ticks.zero >= 0);
    CHECK(ticks.zero <= 2);
  }
}

TEST_CASE("measure: faults of serial" * doctest::skip()) {
  for (const SerialFault& fault : serial_faults()) {
    const SerialFaultTicks ticks = count_ticks(fault);
    std::printf("| %s | %d | %d |\n", fault.name, ticks.noticed, ticks.zero);
  }
}

TEST_CASE("every fault of a serial line is got over without opening the device again") {
  for (const SerialFault& fault : serial_faults()) {
    CAPTURE(fault.name);
    SerialBench b;
    b.push();
    b.rig.lie = fault.lie;
    if (fault.happen != nullptr) fault.happen(b);
    for (int i = 0; i < 20; ++i) b.tick();
    b.rig.lie = Lie::none;
    if (!b.connected) b.plug_in("ttyACM3");  // elsewhere: its link by serial number leads there
    b.gate->stop();
    b.tick(DeviceRequest::clear_fault);
    b.sample = {};
    b.push();
    CHECK(b.report().problem.empty());
  }
}

TEST_CASE("a frame that is lost now and then costs nothing, and two ticks without a sample only the force") {
  SerialBench b;
  b.push();
  for (int i = 0; i < 10; ++i) {
    b.rig.lie = Lie::wrong_crc;
    b.tick();
    b.rig.lie = Lie::none;
    for (int j = 0; j < 3; ++j) {
      b.tick();
      CHECK(b.sample.force_n == b.wanted_n);
    }
  }
  CHECK(b.report().crc_errors == 10);
  CHECK(b.report().lost == 10);
  b.wanted_n = {0.0, 0.0, 4.0};
  for (int i = 0; i < 5; ++i) b.tick();
  b.rig.lie = Lie::silence;
  for (int i = 0; i < 4; ++i) b.tick();
  CHECK(b.sample.force_n == Vec3(0.0));
  CHECK(b.sample.state == DeviceState::ready);
  b.rig.lie = Lie::none;
  b.tick();
  b.tick();  // comes back as slowly as the gate lets a force grow
  CHECK(b.sample.force_n.z == approx(2.0));
  b.tick();
  CHECK(b.sample.force_n.z == approx(4.0));
  CHECK(b.sample.state == DeviceState::ready);
}

TEST_CASE("a firmware that does not hear is stopped by its own watchdog, and the driver says so") {
  SerialBench b;
  b.push();
  b.rig.lie = Lie::deaf;
  int pushing = 0;
  for (int i = 0; i < 40; ++i) {
    b.tick();
    if (b.rig.force_n[2] != 0.0) ++pushing;
  }
  CHECK(pushing >= 19);
  CHECK(pushing <= 21);  // 20 ms after the last command
  CHECK(b.sample.state == DeviceState::faulted);
  CHECK(b.sample.force_n == Vec3(0.0));
  CHECK(b.report().problem.find("does not hear commands") != std::string::npos);
}

TEST_CASE("a force from before it was unplugged is not sent to a serial device that is plugged in") {
  SerialBench b;
  b.push();
  REQUIRE(b.rig.firmware.state == TANGENT_READY);
  in_exchange = [&b] {  // the servo stands still in the middle of its exchange
    b.unplug();
    b.plug_in("ttyACM0", false);
  };
  b.tick();
  CHECK_FALSE(in_exchange);
  CHECK(b.rig.firmware.state == TANGENT_READY);  // it would push
  CHECK(b.rig.force_n == std::array<double, 3>{});
  b.tick();
  CHECK(b.sample.state == DeviceState::firmware);  // to be homed, and armed, again
  CHECK(b.sample.force_n == Vec3(0.0));
  CHECK(b.rig.force_n == std::array<double, 3>{});
}

TEST_CASE("closing sends a stop and lets the port go") {
  SerialBench b;
  b.push();
  b.device.close();
  REQUIRE(eventually([&] {
    b.rig.listen();
    return b.rig.force_n == std::array<double, 3>{};
  }));
  CHECK(b.rig.firmware.state == TANGENT_IDLE);
  CHECK(b.device.exchange({}, 1e-3).state == DeviceState::absent);
  SerialForceDevice other(bench_options(b.dev));
  const Answering answering(b.rig);
  CHECK(other.open());
}

TEST_CASE("another device in the same place is not taken for the one that was opened") {
  SerialBench b;
  b.push();
  b.unplug();
  b.tick();
  CHECK(b.sample.state == DeviceState::absent);
  tangent_description other = three_axes();
  other.serial = 78;
  SerialRig stranger(other);
  stranger.plug_in(b.dev, "ttyACM0", SerialBench::kId);
  REQUIRE(eventually([&] {
    stranger.listen();
    b.sample = b.device.exchange({}, 1e-3);
    return b.sample.state == DeviceState::faulted;
  }));
  CHECK(b.sample.fault == DeviceFault::firmware);
  CHECK(b.report().problem.find("not the device that was opened") != std::string::npos);
}

TEST_CASE("what can't be opened on a serial line is said, with what to do") {
  DevFolder dev;
  SerialForceOptions options = bench_options(dev);
  options.answer_s = 0.05;
  const auto refused = [&options] {
    SerialForceDevice device(options);
    const Status opened = device.open();
    return opened ? Error{} : opened.error();
  };
  CHECK(refused().what == "no serial port is attached");
  SerialRig first, second;
  first.plug_in(dev, "ttyACM0", "usb-Tangent_Rig_77-if00");
  second.plug_in(dev, "ttyACM1", "usb-Tangent_Rig_78-if00");
  const Error several = refused();
  CHECK(several.what.find("/ttyACM0 (serial 77), ") != std::string::npos);
  CHECK(several.what.find("/ttyACM1 (serial 78)") != std::string::npos);
  CHECK(several.remedy.find("--serial-port, best by its link") != std::string::npos);
  const std::vector<FoundDevice> found = find_serial_devices(dev.path());
  REQUIRE(found.size() == 2);
  CHECK(found[1].serial == "78");
  CHECK(found[1].can_be_opened());
  options.port = (dev.path() / "ttyACM0").string();
  CHECK(refused().what == "nothing on this port answers as a force device");
  options.port = (dev.path() / "ttyACM9").string();
  CHECK(refused().what == "no such serial port");
  options.port = "/dev/null";
  CHECK(refused().what == "is no serial port");
  struct stat about {};
  REQUIRE(stat(dev.path().c_str(), &about) == 0);
  const struct group* owner = getgrgid(about.st_gid);
  const std::string group = owner != nullptr ? owner->gr_name : "dialout";
  const Error forbidden = serial_error(EACCES, dev.path().string());
  CHECK(forbidden.what == "you may not open it: it belongs to the group " + group);
  CHECK(forbidden.remedy == "sudo adduser \"$USER\" " + group + ", then log in again");
  CHECK(serial_error(EACCES, "/nowhere").remedy == "sudo adduser \"$USER\" dialout, then log in again");
}

TEST_CASE("a serial port that another program holds, a display and another version are named") {
  DevFolder dev;
  SerialRig rig;
  rig.plug_in(dev);
  SerialForceOptions options = bench_options(dev);
  const auto refused = [&] {
    SerialForceDevice device(options);
    const Answering answering(rig);
    const Status opened = device.open();
    return opened ? std::string() : opened.error().what;
  };
  {
    SerialPort holder;
    REQUIRE(holder.open((dev.path() / "ttyACM0").c_str(), 115200) == 0);
    CHECK(refused() == "another program uses it");
    int exclusive = 0;  // and still has it for itself
    REQUIRE(ioctl(holder.fd(), TIOCGEXCL, &exclusive) == 0);
    CHECK(exclusive != 0);
  }
  CHECK(refused().empty());
  rig.version = 2;
  CHECK(refused() == "its firmware speaks another version of the force messages");
  rig.old_display = true;
  CHECK(refused() == "its firmware knows no force messages: it is a display");
}

TEST_CASE("nonsense that a firmware says about itself is refused") {
  tangent_description is = three_axes();
  SUBCASE("a continuous force above the peak") { is.continuous_mn = 6000; }
  SUBCASE("no watchdog") { is.watchdog_ms = 0; }
  SUBCASE("40 buttons") { is.buttons = 40; }
  DevFolder dev;
  SerialRig rig(is);
  rig.plug_in(dev);
  SerialForceDevice device(bench_options(dev));
  const Answering answering(rig);
  CHECK_FALSE(device.open());
}

TEST_CASE("with one axis the finger's other coordinates are zero, and no force goes along them") {
  tangent_description is = three_axes();
  is.pushes_along = 4;
  is.senses_rotation = 0;
  is.workspace_um[0] = is.workspace_um[1] = 0;
  SerialBench b(is);
  CHECK(b.device.capabilities().pushes_along == std::array<bool, 3>{false, false, true});
  b.push();
  b.rig.lie = Lie::outside;  // along y, which it lacks: not believed, and no reason to stop
  for (int i = 0; i < 5; ++i) b.tick();
  CHECK(b.sample.state == DeviceState::ready);
  CHECK(b.sample.position_m.x == 0.0);
  CHECK(b.sample.position_m.y == 0.0);
  CHECK(b.sample.orientation == Quat(1.0, 0.0, 0.0, 0.0));
  b.wanted_n = {3.0, 3.0, 1.0};
  for (int i = 0; i < 5; ++i) b.tick();
  CHECK(b.sample.force_n == Vec3(0.0, 0.0, 1.0));
  CHECK(b.rig.force_n[0] == 0.0);
}

TEST_CASE("in 200 ticks through a serial line nothing is lost either way") {
  SerialBench b;
  b.push();
  const LinkReport before = b.report();
  for (int i = 0; i < 200; ++i) {
    b.wanted_n.z = 1.0 + 0.01 * (i % 100);
    b.tick();
    REQUIRE(b.rig.force_n[2] == approx(b.sample.force_n.z).epsilon(1e-5).scale(0.1));
  }
  const LinkReport after = b.report();
  CHECK(after.frames == before.frames + 200);
  CHECK(after.packets_out == before.packets_out + 200);
  CHECK(after.lost + after.doubled + after.late + after.crc_errors + after.lost_by_device == 0);
  CHECK(after.dropped_commands == 0);
}
