#include "devices/haply/haply_device.h"
#include "devices/base/realtime_thread.h"
#include "devices/haply/haply_list.h"
#include "devices/plugin/host/allocation_watch.h"
#include "tests/devices/haply/haply_faults.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include <sys/resource.h>

using namespace tangent;
using namespace tangent::testing;
using emulation::eventually;
using tangent::test::approx;

namespace {

/// s of processor time of the thread of this name.
double thread_time_s(const std::string& name) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string comm;
    std::getline(std::ifstream(task.path() / "comm"), comm);
    double ns = 0.0;
    if (comm == name) return std::ifstream(task.path() / "schedstat") >> ns ? ns * 1e-9 : 0.0;
  }
  return 0.0;
}

struct RealTimeRun {
  int ticks = 0, quiet = 0, lost = 0;
  double wall_s = 0.0, link_s = 0.0;
};

/// Ticks by the clock, as the servo makes them.
RealTimeRun run_by_the_clock(HaplyRig& rig, int ticks) {
  RealTimeRun run;
  const auto begin = std::chrono::steady_clock::now();
  const LinkReport before = rig.report();
  const double link_before_s = thread_time_s("tangent-haply");
  for (; run.ticks < ticks; ++run.ticks) {
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(run.ticks + 1));
    rig.tick();
  }
  const LinkReport after = rig.report();
  run.link_s = thread_time_s("tangent-haply") - link_before_s;
  run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.quiet = static_cast<int>(after.late - before.late);
  run.lost = ticks - static_cast<int>(after.packets_in - before.packets_in);
  return run;
}

struct Priorities {
  bool servo = false, link = false, service = false;
};

/// A row of the table: 10,000 ticks by the clock, these threads with real-time priority.
void measure_priorities(const char* name, Priorities real_time) {
  HaplyService service({.realtime = real_time.service});
  HaplyOptions options = stepped_haply(service);
  options.realtime = real_time.link;
  HaplyRig rig(service, options);
  REQUIRE(rig.device.open());
  REQUIRE(rig.reach(DeviceState::firmware));
  REQUIRE(rig.reach(DeviceState::ready, DeviceRequest::home));
  RealTimeRun run;
  std::thread servo([&] {
    if (real_time.servo && !ask_for_realtime(kServoPriority)) std::puts("SCHED_FIFO refused");
    run = run_by_the_clock(rig, 10'000);
  });
  servo.join();
  CHECK(rig.sample.state == DeviceState::ready);
  const LogHistogram& trip_us = *rig.report().round_trip_us;
  std::printf("| %s | %d | %d | %.0f us | %.0f us | %.1f %% |\n", name, run.lost, run.quiet, trip_us.percentile(0.5),
              trip_us.percentile(0.99), 100.0 * run.link_s / run.wall_s);
}

std::string remedy_of(HaplyService& service, const std::string& device = {}) {
  HaplyOptions options = stepped_haply(service);
  options.device = device;
  HaplyForceDevice haply(options);
  const Status opened = haply.open();
  return opened ? "opened" : opened.error().what + "; " + opened.error().remedy;
}

}  // namespace

TEST_CASE("an Inverse3 is opened, homed, pushes with what the gate lets through, and ends at zero") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.device.open());
  CHECK(rig.device.capabilities().serial == "049D");
  CHECK_FALSE(rig.device.open());
  rig.tick();
  CHECK(rig.sample.state != DeviceState::ready);
  REQUIRE(rig.arm_and_push());
  CHECK(glm::length(rig.sample.position_m) < 1e-12);  // in the middle of its workspace
  CHECK(rig.sample.buttons == 1u);
  CHECK(rig.sample.age_s < 2.5e-3);
  CHECK(service.asked().back().find("\"vector\"") != std::string::npos);
  CHECK(rig.report().identity == "device 049D, turned by its VerseGrip");
  rig.device.close();
  CHECK(eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0));
  CHECK(eventually([&] { return service.closed_politely(); }, 60.0));
  CHECK(rig.device.exchange({}, 1e-3).state == DeviceState::absent);
}

TEST_CASE("Haply's axes: its x is the world's -y, its y the world's x, and up is up") {
  const HaplyForceDevice device;
  const DeviceFrame& frame = device.capabilities().frame;
  CHECK(glm::length(turned(frame.rotation, Vec3(1, 0, 0)) - Vec3(0, -1, 0)) < 1e-12);
  CHECK(glm::length(turned(frame.rotation, Vec3(0, 1, 0)) - Vec3(1, 0, 0)) < 1e-12);
  CHECK(glm::length(turned(frame.rotation, Vec3(0, 0, 1)) - Vec3(0, 0, 1)) < 1e-12);
  CHECK(check_capabilities(device.capabilities()));
}

TEST_CASE("the finger points where a Haply VerseGrip points, its y, and keeps the grip's upper side up") {
  const double half = std::sqrt(0.5);
  struct {
    Quat grip;
    Vec3 finger, up;  // in Haply's axes: right, away, up
  } const turns[] = {{Quat(1, 0, 0, 0), {0, 1, 0}, {0, 0, 1}},
                     {Quat(half, 0, 0, half), {-1, 0, 0}, {0, 0, 1}},
                     {Quat(half, half, 0, 0), {0, 0, 1}, {0, -1, 0}},
                     {Quat(half, 0, half, 0), {0, 1, 0}, {1, 0, 0}}};
  for (const auto& turn : turns) {
    HaplyService service({.grip = turn.grip});
    HaplyRig rig(service);
    REQUIRE(rig.device.open());
    CHECK(rig.device.capabilities().rotations_sensed() == 3);
    REQUIRE(rig.reach(DeviceState::firmware));
    REQUIRE(rig.answered_tick());
    rig.tick();
    CHECK(glm::length(turned(rig.sample.orientation, Vec3(1, 0, 0)) - turn.finger) < 1e-12);
    CHECK(glm::length(turned(rig.sample.orientation, Vec3(0, 0, 1)) - turn.up) < 1e-12);
  }
  HaplyService without({.grip = std::nullopt});
  HaplyRig rig(without);
  REQUIRE(rig.push());
  CHECK(rig.device.capabilities().rotations_sensed() == 0);
  CHECK(rig.sample.orientation == Quat(1, 0, 0, 0));
}

TEST_CASE("a Haply VerseGrip that is listed and no longer says how it is turned is a fault, after a few states") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  const std::uint64_t errors = rig.report().errors;
  reply_changed(service, "orientation", "orientated");
  for (int i = 0; i < 20; ++i) {
    REQUIRE(rig.answered_tick());
    CHECK(rig.sample.state == DeviceState::ready);
  }
  CHECK(rig.report().errors == errors);
  REQUIRE(rig.answered_tick());
  CHECK(rig.report().errors > errors);
  rig.tick();
  CHECK(rig.sample.fault == DeviceFault::sensor);
  CHECK(rig.sample.force_n == Vec3(0.0));
  CHECK(rig.report().problem.find("VerseGrip no longer says") != std::string::npos);
  CHECK(eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0));
}

TEST_CASE("a Haply VerseGrip that says no turn to a new connection is a fault, and the finger does not turn back") {
  const double half = std::sqrt(0.5);
  HaplyService service({.grip = Quat(half, half, 0.0, 0.0)});
  HaplyRig rig(service);
  REQUIRE(rig.push());
  const Quat before = rig.sample.orientation;
  const LinkReport report = rig.report();
  reply_changed(service, "orientation", "orientated");
  service.drop();
  REQUIRE(
      eventually([&] { return rig.report().connects > report.connects && rig.report().errors > report.errors; }, 60.0));
  rig.tick();
  CHECK(rig.sample.fault == DeviceFault::sensor);
  CHECK(rig.sample.orientation == before);
  service.set_policy({});
  for (int i = 0; i < 3; ++i) REQUIRE(rig.answered_tick());  // all that was sent before is heard
  REQUIRE(rig.answered_tick(DeviceRequest::clear_fault));
  CHECK(rig.arm_and_push());
}

TEST_CASE("an error that the Inverse Service reports of the device ends the force, and a warning is shown") {
  HaplyService service, events;
  reply_with(events, {HaplyReply::How::nothing, ""});
  HaplyOptions options = stepped_haply(service);
  const std::string address = events.address();
  options.events_port = std::stoi(address.substr(address.rfind(':') + 1));
  HaplyRig rig(service, options);
  REQUIRE(rig.push());
  const auto event = [&](const char* level, const char* id, const char* text) {
    events.push(std::string(R"({"name":"device-safety-triggered","category":"device","level":")") + level +
                R"(","data":{"device_id":")" + id + R"("},"message":")" + text + R"("})");
  };
  REQUIRE(eventually([&] { return rig.report().identity.find("not heard") == std::string::npos; }, 60.0));
  events.push("no event");
  event("error", "04BA", "of another device");
  event("warning", "049D", "stall");
  REQUIRE(eventually(
      [&] { return rig.report().identity.find("warned: device-safety-triggered: stall") != std::string::npos; }, 60.0));
  REQUIRE(rig.answered_tick());
  CHECK(rig.sample.force_n != Vec3(0.0));
  event("error", "049D", "E-brake");
  REQUIRE(eventually([&] { return rig.report().identity.find("E-brake") != std::string::npos; }, 60.0));
  rig.tick();
  CHECK(rig.sample.fault == DeviceFault::actuator);
  CHECK(rig.sample.force_n == Vec3(0.0));
  CHECK(rig.report().problem.find("reports an error (device-safety-triggered: E-brake)") != std::string::npos);
  CHECK(eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0));
  CHECK(events.received() == 0);  // nothing is ever sent there
  REQUIRE(rig.answered_tick(DeviceRequest::clear_fault));
  events.go_away();
  CHECK(eventually([&] { return rig.report().identity.find("not heard") != std::string::npos; }, 60.0));
  CHECK(rig.arm_and_push());
}

TEST_CASE("an Inverse Service that keeps lying is told zero force once, and not asked again and again") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  reply_text(service, "?");
  const std::uint64_t before = service.received(), bad = rig.report().errors;
  rig.tick();
  REQUIRE(eventually([&] { return rig.report().errors >= bad + 2 && service.force_n() == Vec3(0.0); }, 60.0));
  for (int i = 0; i < 20; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(service.received() == before + 2);
}

TEST_CASE("an Inverse Service that keeps lying is not taken for a silent one, and the reason stays") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  const std::uint64_t connects = rig.report().connects;
  reply_text(service, "?");
  for (int i = 0; i < 150; ++i) REQUIRE(rig.answered_tick());  // longer than silence_s
  CHECK(rig.report().connects == connects);
  CHECK(rig.sample.fault == DeviceFault::firmware);
  CHECK(rig.report().problem.find("no state message") != std::string::npos);
}

TEST_CASE("states that nobody asked for are no fault while there are ten times as many answers") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.device.open());
  std::string state;
  service.set_policy([&](std::uint64_t, const std::string& right) {
    state = right;
    return HaplyReply{HaplyReply::How::send, right};
  });
  REQUIRE(rig.answered_tick());
  service.set_policy({});
  for (int i = 0; i < 110; ++i) {
    const std::uint64_t heard = rig.report().packets_in;
    service.push(state);
    REQUIRE(eventually([&] { return rig.report().packets_in > heard; }, 60.0));
    for (int k = 0; k < 10; ++k) REQUIRE(rig.answered_tick());
  }
  CHECK(rig.report().errors == 0);
}

TEST_CASE("the devices of an Inverse Service are listed, and it is sent nothing") {
  HaplyService service({.devices = {"049D", "04BA"}});
  const auto two = list_haply_devices(stepped_haply(service));
  REQUIRE(two);
  REQUIRE(two->size() == 2);
  CHECK(two->back().kind == "haply");
  CHECK(two->back().serial == "04BA");
  CHECK(two->back().can_be_opened());
  service.set_options({.in_use = true});
  CHECK(list_haply_devices(stepped_haply(service))->front().problem.remedy == "close that program");
  service.set_options({.power = false});
  CHECK_FALSE(list_haply_devices(stepped_haply(service))->front().can_be_opened());
  service.set_options({.devices = {}});
  CHECK(list_haply_devices(stepped_haply(service))->empty());
  reply_text(service, "hello");
  CHECK(list_haply_devices(stepped_haply(service)).error().what.find("no state message") != std::string::npos);
  reply_with(service, {HaplyReply::How::nothing, ""});
  HaplyOptions impatient = stepped_haply(service);
  impatient.connect_s = 0.2;
  std::string remedy;  // a slow machine may need several attempts to connect in this time
  for (int i = 0; i < 20 && remedy != "start it again in Haply Hub"; ++i)
    remedy = list_haply_devices(impatient).error().remedy;
  CHECK(remedy == "start it again in Haply Hub");
  CHECK(service.received() == 0);
  service.go_away();
  CHECK(list_haply_devices(stepped_haply(service)).error().remedy.find("start Haply Hub") != std::string::npos);
}

TEST_CASE("an Inverse Service of 3.1 gets its forces as values") {
  HaplyService service({.old_format = true});
  HaplyRig rig(service);
  CHECK(rig.push());
  CHECK(service.asked().back().find("\"values\"") != std::string::npos);
}

TEST_CASE("a free mass at the emulated Inverse3 is moved by the force that was sent") {
  HaplyService service({.mass_kg = 0.2});
  HaplyRig rig(service);
  rig.wanted_n = Vec3(0.0, 0.0, 0.1);
  REQUIRE(rig.device.open());
  REQUIRE(rig.reach(DeviceState::firmware));
  REQUIRE(rig.reach(DeviceState::ready, DeviceRequest::home));
  double impulse = 0.0;
  for (int i = 0; i < 50; ++i) {  // straight to the driver: no hand holds it, which the gate would stop
    const std::uint64_t heard = rig.report().packets_in;
    ++g_haply_ms;
    rig.sample = rig.device.exchange({.force_n = rig.wanted_n}, 1e-3);
    impulse += rig.sample.force_n.z * 1e-3;
    REQUIRE(eventually([&] { return rig.report().packets_in > heard; }));
  }
  rig.tick();
  REQUIRE(rig.sample.velocity_m_per_s.has_value());
  CHECK(rig.sample.velocity_m_per_s->z == approx(impulse / 0.2).epsilon(0.01));
  CHECK(rig.sample.position_m.z > 0.0);
}

TEST_CASE("an Inverse Service that is missing, empty, crowded or in use is said, with what to do") {
  HaplyService service({.devices = {"049D", "04BA"}});
  CHECK(remedy_of(service).find("several (049D, 04BA); choose one by --haply-device") != std::string::npos);
  CHECK(remedy_of(service, "04BA") == "opened");
  CHECK(remedy_of(service, "FFFF").find("no Inverse3 of this id (049D, 04BA)") != std::string::npos);
  CHECK(remedy_of(service, "a b").find("no id") != std::string::npos);
  service.set_options({.devices = {}});
  CHECK(remedy_of(service).find("plug it in") != std::string::npos);
  service.set_options({.in_use = true});
  CHECK(remedy_of(service).find("close that program") != std::string::npos);
  service.set_options({.permutation = "XZY"});
  CHECK(remedy_of(service).find("other axes") != std::string::npos);
  service.set_options({});
  reply_text(service, "hello");
  CHECK(remedy_of(service).find("no state message") != std::string::npos);
  service.set_policy({});
  service.go_away();
  CHECK(remedy_of(service).find("start Haply Hub") != std::string::npos);
}

TEST_CASE("every fault of an Inverse Service is noticed, and no force is sent two ticks later at most") {
  for (const HaplyFault& fault : haply_faults()) {
    CAPTURE(fault.name);
    const HaplyFaultSeen seen = measure_haply_fault(fault);
    CHECK(seen.to_notice >= 1);
    CHECK(seen.to_notice <= 2);
    CHECK(seen.to_zero >= 1);
    CHECK(seen.to_zero <= 2);
    CHECK(seen.service_has_zero);
  }
}

TEST_CASE("an Inverse Service that is silent for longer is a fault, is connected to again, and stays without force") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  const std::uint64_t connects = rig.report().connects;
  service.set_policy([](std::uint64_t n, const std::string& right) {  // it lists its devices to whoever connects
    return HaplyReply{n == 0 ? HaplyReply::How::send : HaplyReply::How::nothing, right};
  });
  bool faulted = false;
  for (int i = 0; i < 150 && !faulted; ++i) {
    rig.tick();
    faulted = rig.sample.fault == DeviceFault::disconnected;
  }
  CHECK(faulted);
  service.set_policy({});
  CHECK(eventually([&] { return rig.report().connects > connects; }, 60.0));
  CHECK(rig.reach(DeviceState::firmware));
  CHECK(rig.sample.force_n == Vec3(0.0));
}

TEST_CASE("an Inverse Service that comes back is used again, after homing and arming") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  service.go_away();
  REQUIRE(eventually([&] { return !rig.report().connected; }));
  rig.tick();
  CHECK(rig.sample.state == DeviceState::absent);
  CHECK(rig.report().problem.find("Inverse Service") != std::string::npos);
  const std::uint64_t connects = rig.report().connects;
  service.come_back();
  REQUIRE(eventually([&] { return rig.report().connects > connects && rig.report().connected; }, 60.0));
  REQUIRE(eventually([&] { return !rig.report().identity.empty(); }, 60.0));
  rig.sample = {};
  CHECK(rig.arm_and_push());
}

TEST_CASE("an Inverse3 that was not listed for one answer between two ticks has to be homed again") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  reply_changed(service, "049D", "04BA");
  REQUIRE(rig.answered_tick());
  service.set_policy({});
  REQUIRE(eventually([&] { return !rig.report().identity.empty(); }, 60.0));  // listed again
  rig.tick();
  CHECK(rig.sample.state != DeviceState::ready);
  CHECK(rig.sample.force_n == Vec3(0.0));
  CHECK(eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0));
}

TEST_CASE("an Inverse Service that takes a connection and says nothing is connected to again and again") {
  HaplyService service;
  HaplyOptions options = stepped_haply(service);
  options.connect_s = 0.3;
  HaplyRig rig(service, options);
  bool opened = false;  // a slow machine may need several attempts
  for (int i = 0; i < 100 && !opened; ++i) opened = rig.device.open().has_value();
  REQUIRE(opened);
  reply_with(service, {HaplyReply::How::nothing, ""});
  service.drop();
  const std::uint64_t connects = rig.report().connects;
  CHECK(eventually([&] { return rig.report().connects > connects + 2; }, 60.0));
  service.set_policy({});
  CHECK(eventually([&] { return !rig.report().identity.empty(); }, 60.0));
  reply_with(service, {HaplyReply::How::nothing, ""});
  CHECK_FALSE(HaplyForceDevice(options).open());
}

TEST_CASE("an Inverse3 that is not calibrated is homing until a person has put it into its inkwell") {
  HaplyService service({.calibrated = false});
  HaplyRig rig(service);
  REQUIRE(rig.device.open());
  REQUIRE(rig.reach(DeviceState::firmware));
  CHECK(rig.reach(DeviceState::homing, DeviceRequest::home));
  for (int i = 0; i < 20; ++i) REQUIRE(rig.answered_tick());
  CHECK(rig.sample.state == DeviceState::homing);
  service.set_options({});
  CHECK(rig.reach(DeviceState::ready));
}

TEST_CASE("a faulted Inverse3 is ready again when the fault is cleared and it is homed") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  reply_text(service, "?");
  REQUIRE(rig.answered_tick());
  service.set_policy({});
  REQUIRE(rig.answered_tick());
  CHECK(rig.sample.state == DeviceState::faulted);
  CHECK(rig.sample.fault == DeviceFault::firmware);
  CHECK(rig.report().problem.find("no state message") != std::string::npos);
  REQUIRE(rig.answered_tick(DeviceRequest::clear_fault));
  CHECK(rig.report().problem.empty());
  CHECK(rig.arm_and_push());
}

TEST_CASE("answers that come late make it fall silent, and too many of them are a fault") {
  std::atomic<std::uint64_t> held{0};
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  int pauses = 0;
  while (rig.sample.state == DeviceState::ready && pauses < 20) {
    service.set_policy([&](std::uint64_t, const std::string& right) {
      ++held;
      return HaplyReply{HaplyReply::How::hold, right};
    });
    // Until all that was answered, the list first, is heard: nothing more comes now.
    const auto all_heard = [&] {
      const std::uint64_t over = rig.report().packets_in + held;
      return over >= service.received() + 1;  // read last: one that comes meanwhile is held as well
    };
    REQUIRE(eventually(all_heard, 60.0));
    rig.tick(), rig.tick(), rig.tick(), rig.tick();
    CHECK(rig.sample.force_n == Vec3(0.0));
    REQUIRE(eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0));
    service.set_policy({});
    const std::uint64_t heard = rig.report().packets_in;
    service.release_held();
    held = 0;
    REQUIRE(eventually([&] { return rig.report().packets_in > heard; }, 60.0));
    REQUIRE(rig.answered_tick());
    ++pauses;
  }
  CHECK(pauses > 1);
  CHECK(rig.sample.fault == DeviceFault::disconnected);
}

TEST_CASE("no exchange with an Inverse3 allocates, answered or not, nor when its service is gone") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  std::uint64_t sum = 0;
  const auto exchange = [&](int times, DeviceRequest request = DeviceRequest::none) {
    for (int i = 0; i < times; ++i) {
      count_allocations();
      rig.device.exchange({.force_n = Vec3(0.0, 0.0, 0.5), .request = request}, 1e-3);
      sum += counted_allocations();
    }
  };
  for (int i = 0; i < 50; ++i) {
    const std::uint64_t heard = rig.report().packets_in;
    exchange(1);
    REQUIRE(eventually([&] { return rig.report().packets_in > heard; }, 60.0));
  }
  reply_text(service, "?");
  exchange(50);
  for (const DeviceRequest request : {DeviceRequest::stop, DeviceRequest::clear_fault, DeviceRequest::home})
    exchange(5, request);
  service.go_away();
  exchange(150);
  CHECK(sum == 0);
}

TEST_CASE("an emergency stop reaches the Inverse Service without an exchange, and holds until it is homed again") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.push());
  REQUIRE(rig.device.emergency_stop());
  CHECK(eventually([&] { return service.force_n() == Vec3(0.0); }));
  for (int i = 0; i < 5; ++i) {
    REQUIRE(rig.answered_tick());
    CHECK(rig.sample.state != DeviceState::ready);
    CHECK(service.force_n() == Vec3(0.0));
  }
  CHECK(rig.arm_and_push());
}

TEST_CASE("an Inverse3 may be told to stop by another thread while it is opened and closed") {
  HaplyService service;
  HaplyRig rig(service);
  std::atomic<bool> going{true};
  std::atomic<int> calls{0};
  std::thread other([&] {
    for (; going; ++calls) rig.device.emergency_stop();
  });
  for (int round = 0; round < 3; ++round) {
    const int before = calls;
    CHECK(eventually([&] { return calls > before + 10; }));
    CHECK(rig.device.open());
    rig.device.close();
  }
  going = false;
  other.join();
  CHECK(rig.push());  // and works afterwards
}

TEST_CASE("when our ticks stall, the link's thread sends the Inverse Service zero force") {
  HaplyService service;
  HaplyOptions options = stepped_haply(service);
  options.our_stall_s = 0.2;
  HaplyRig rig(service, options);
  REQUIRE(rig.device.open());
  REQUIRE(rig.reach(DeviceState::firmware));
  REQUIRE(rig.reach(DeviceState::ready, DeviceRequest::home));
  const auto exchange = [&] { return rig.device.exchange({.force_n = Vec3(0, 0, 1)}, 1e-3).force_n; };
  CHECK(exchange() == Vec3(0, 0, 1));
  const std::uint64_t forces = service.forces();
  CHECK(eventually([&] { return service.forces() > forces + 3 && service.force_n() == Vec3(0.0); }, 60.0));
}

TEST_CASE("an Inverse3 is never sent more than its largest force, nor one that is not finite") {
  HaplyService service;
  HaplyRig rig(service);
  REQUIRE(rig.device.open());
  REQUIRE(rig.reach(DeviceState::firmware));
  REQUIRE(rig.reach(DeviceState::ready, DeviceRequest::home));
  const Vec3 sent = rig.device.exchange({.force_n = Vec3(30, -40, 0)}, 1e-3).force_n;
  CHECK(glm::length(sent - Vec3(1.8, -2.4, 0)) < 1e-12);
  CHECK(eventually([&] { return glm::length(service.force_n() - sent) < 1e-6; }));
  const ForceSample refused = rig.device.exchange({.force_n = Vec3(0, std::nan(""), 0)}, 1e-3);
  CHECK(refused.fault == DeviceFault::bad_command);
  CHECK(refused.force_n == Vec3(0.0));
  CHECK(eventually([&] { return service.force_n() == Vec3(0.0); }));
}

TEST_CASE("200 ticks by the clock through an Inverse3: every one is answered, or counted as one that was not") {
  HaplyService service;
  HaplyOptions options = stepped_haply(service);
  options.silence_s = 1e6;
  HaplyRig rig(service, options);
  REQUIRE(rig.device.open());
  REQUIRE(rig.reach(DeviceState::firmware));
  const RealTimeRun run = run_by_the_clock(rig, 200);
  CHECK(run.ticks == 200);
  CHECK(rig.report().errors == 0);
  // The list of devices, and an answer for each message: no force is sent out of turn, since none was to be.
  CHECK(eventually([&] { return rig.report().packets_in == rig.report().packets_out + 1; }, 60.0));
}

TEST_CASE("measure: faults of haply" * doctest::skip()) {
  std::puts("| fault | ticks to notice | ticks to zero force |\n|---|---|---|");
  for (const HaplyFault& fault : haply_faults()) {
    const HaplyFaultSeen seen = measure_haply_fault(fault);
    std::printf("| %s | %d | %d |\n", fault.name, seen.to_notice, seen.to_zero);
  }
}

TEST_CASE("measure: 10,000 ticks through haply" * doctest::skip()) {
  std::puts(
      "| SCHED_FIFO | no answer | no force | round trip, median | p99 | link's thread |\n|---|---|---|---|---|---|");
  measure_priorities("none", {.servo = false, .link = false, .service = false});
  measure_priorities("servo", {.servo = true, .link = false, .service = false});
  measure_priorities("servo, link", {.servo = true, .link = true, .service = false});
  measure_priorities("servo, link, service", {.servo = true, .link = true, .service = true});
}
