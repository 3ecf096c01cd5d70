// A whole session with a CLD controller on USB: servo thread, link thread, gate. Faults of the link switch the force
// off.
#include "workbench/session/session.h"

#include "core/lab/objects/generate.h"
#include "tests/devices/usb/emulation/cld_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"

#include <functional>
#include <memory>
#include <vector>

using namespace tangent;
using namespace tangent::emulation;

namespace {

std::shared_ptr<const ContactScene> sphere() {
  auto mesh = ContactMesh::build(make_icosphere(0.040, 3));
  REQUIRE(mesh);
  auto scene = ContactScene::build(std::move(*mesh));
  REQUIRE(scene);
  return *scene;
}

struct SessionBench {
  Testbed testbed;
  CldModel model;
  PluggedDevice device{testbed, model, 4};
  std::unique_ptr<Session> session;
  std::vector<ServoRecord> records;

  explicit SessionBench(ArmOnStart arm = ArmOnStart::always) {
    model.watchdog_on = false;  // the gate is what is tested here
    device.plug_in();
    device.run();
    SessionOptions options;
    options.devices = {"simulated", "cld"};
    options.arm_on_start = arm;
    auto made = Session::create(sphere(), Preset{}, options);
    REQUIRE(made);
    session = std::move(*made);
    session->attach_recorder();
    session->start();
  }
  ~SessionBench() { static_cast<void>(session->shut_down()); }

  void take() {
    session->poll();
    ServoRecord record;
    while (session->pop_recorded(record)) records.push_back(record);
  }
  bool display_is_ready() {
    take();
    return !records.empty() && records.back().device.display_state == DeviceState::ready;
  }
  bool armed_and_ready() {
    return eventually([&] {
      const bool is_ready = display_is_ready();
      // The test machine is not real-time, so late ticks occur: the test re-arms, as a person would.
      if (session->status().servo.gate_state == GateState::faulted) session->arm();
      return is_ready && records.back().device.gate_state == GateState::armed &&
             records.back().device.force_rendered_n != Vec3(0.0);
    });
  }
  /// Ticks from the first in which the gate is faulted to the first without force at the device.
  int ticks_to_zero(std::size_t from, GateFault& fault) {
    REQUIRE(eventually([&] {
      take();
      return records.back().device.gate_state == GateState::faulted;
    }));
    const std::size_t enough = records.size() + 20;
    REQUIRE(eventually([&] {
      take();
      return records.size() >= enough;
    }));
    std::size_t first = from;
    while (records[first].device.gate_state != GateState::faulted) ++first;
    fault = records[first].device.gate_fault;
    int ticks = 0;
    while (records[first + static_cast<std::size_t>(ticks)].device.force_command_n != Vec3(0.0)) ++ticks;
    for (std::size_t i = first + static_cast<std::size_t>(ticks); i < records.size(); ++i)
      CHECK(records[i].device.force_command_n == Vec3(0.0));
    return ticks + 1;  // the command of a tick is rendered in the next
  }
};

}  // namespace

TEST_CASE("a session with a CLD on USB keeps the clock's time, homes it and drives it") {
  SessionBench b;
  REQUIRE(b.armed_and_ready());
  CHECK(b.session->options().servo.time_by_deadlines);
  CHECK(b.device.board.with_model([&] { return b.model.state(); }) == CldDeviceState::ready);
  LinkReport link;
  REQUIRE(b.session->display_report(link));
  CHECK(link.connected);
  CHECK(link.round_trip_us->count() > 0);
}

TEST_CASE(
    "faults on the cable and in the controller: the force is gone within two ticks of being known, and a person "
    "re-arms") {
  struct Case {
    const char* name;
    std::function<void(SessionBench&)> cause;
  };
  const Case cases[]{
      {"unplugged", [](SessionBench& b) { b.device.unplug(); }},
      {"silent", [](SessionBench& b) { b.device.board.with_model([&] { b.model.telemetry_on = false; }); }},
      {"encoder stuck", [](SessionBench& b) { b.device.board.with_model([&] { b.model.encoder_stuck = true; }); }},
  };
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    SessionBench b;
    REQUIRE(b.armed_and_ready());
    const std::size_t from = b.records.size();
    c.cause(b);
    GateFault fault = GateFault::none;
    CHECK(b.ticks_to_zero(from, fault) <= 2);
    MESSAGE(std::string(c.name) << ": " << std::string(to_string(fault)));
  }
}

TEST_CASE("unplugged and plugged in again under a session, nothing moves until a person re-arms - then all goes on") {
  SessionBench b;
  REQUIRE(b.armed_and_ready());
  b.device.unplug();
  REQUIRE(eventually([&] {
    b.take();
    return b.session->status().servo.gate_state == GateState::faulted;
  }));
  b.device.plug_in();
  REQUIRE(eventually([&] {
    b.take();
    return b.records.back().device.display_state == DeviceState::firmware;
  }));
  const std::size_t from = b.records.size();
  REQUIRE(eventually([&] {
    b.take();
    return b.records.size() > from + 200;
  }));
  for (std::size_t i = from; i < b.records.size(); ++i) {
    // A busy machine keeps the link thread waiting: the device may count as lost again.
    const DeviceState state = b.records[i].device.display_state;
    const bool is_still = state == DeviceState::firmware || state == DeviceState::faulted;
    CHECK(is_still);
    CHECK(b.records[i].device.force_command_n == Vec3(0.0));
  }
  b.session->arm();
  CHECK(b.armed_and_ready());
}

TEST_CASE("with a real device there is no force until a person arms, also where the other device is simulated") {
  // Where a busy machine keeps the link thread waiting before the display is ready, it counts as lost until a person
  // arms: then from the start.
  std::unique_ptr<SessionBench> bench;
  REQUIRE(eventually(
      [&] {
        bench.reset();
        bench = std::make_unique<SessionBench>(SessionOptions{}.arm_on_start);
        return eventually([&] { return bench->display_is_ready(); }, 5.0);
      },
      120.0));
  SessionBench& b = *bench;
  const std::size_t enough = b.records.size() + 1500;
  REQUIRE(eventually([&] {
    b.take();
    return b.records.size() >= enough;
  }));
  for (const ServoRecord& record : b.records) {
    CHECK(record.device.gate_state == GateState::disarmed);
    CHECK(record.device.force_command_n == Vec3(0.0));
  }
  b.session->arm();
  CHECK(b.armed_and_ready());
}
