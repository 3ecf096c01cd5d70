#include "workbench/session/safety_log.h"

#include "tests/workbench/session/session_fixture.h"

#include <algorithm>

using namespace tangent;
using namespace tangent::test;

namespace {

bool has(const SafetyLog& log, SafetyEntry::Kind kind, const std::string& text) {
  return std::any_of(log.entries().begin(), log.entries().end(),
                     [&](const SafetyEntry& e) { return e.kind == kind && e.text == text; });
}

}  // namespace

TEST_CASE("states, faults and interventions are told once each, with their tick") {
  TickBench bench(simulated(), sphere_scene());
  REQUIRE(bench.devices.force->open());
  REQUIRE(bench.devices.display->open());
  SafetyLog log;
  bench.arm();
  for (int i = 0; i < 1500; ++i) log.watch(bench.run());
  CHECK(has(log, SafetyEntry::Kind::state, "force device: ready"));
  CHECK(has(log, SafetyEntry::Kind::state, "contact display: homing"));
  CHECK(has(log, SafetyEntry::Kind::state, "safety gate: armed"));
  bench.channels.faults.put({{InjectedFault::noise, 50}, false});
  for (int i = 0; i < 100; ++i) log.watch(bench.run());
  CHECK(has(log, SafetyEntry::Kind::fault, "safety gate: position jumped"));
  const auto size = log.entries().size();
  for (int i = 0; i < 1000; ++i) log.watch(bench.run());
  CHECK(log.entries().size() == size);  // nothing new
  for (std::size_t i = 1; i < size; ++i) CHECK(log.entries()[i - 1].tick <= log.entries()[i].tick);
}

TEST_CASE("an intervention that goes on is told once, and again after a quiet while - the log is bounded") {
  SafetyLog log;
  ServoRecord record;
  const auto tick = [&](bool clamped) {
    record.device.gate_actions = clamped ? 1u << static_cast<unsigned>(GateAction::force_clamped) : 0u;
    log.watch(record);
    ++record.tick.tick;
  };
  for (int i = 0; i < 100; ++i) tick(true);
  CHECK(log.entries().size() == 1);
  for (int i = 0; i < 600; ++i) tick(false);
  tick(true);
  CHECK(log.entries().size() == 2);
  for (int i = 0; i < 2000; ++i) {
    record.device.force_state = i % 2 == 0 ? DeviceState::open : DeviceState::firmware;
    tick(false);
  }
  CHECK(log.entries().size() == SafetyLog::kMost);
}

TEST_CASE("home lets ready devices find their zero again, without force") {
  TickBench bench(simulated(), sphere_scene());
  REQUIRE(bench.devices.force->open());
  REQUIRE(bench.devices.display->open());
  bench.arm();
  REQUIRE(bench.run(1500).device.gate_state == GateState::armed);
  bench.channels.force.put(ForceSwitch::home);
  bench.run();
  const ServoRecord homing = bench.run();
  CHECK(homing.device.force_state == DeviceState::homing);
  CHECK(homing.device.display_state == DeviceState::homing);
  CHECK(homing.device.force_command_n == Vec3(0.0));
  const ServoRecord after = bench.run(1000);
  CHECK(after.device.force_state == DeviceState::ready);
  CHECK(after.device.display_state == DeviceState::ready);
  CHECK(after.device.gate_state == GateState::disarmed);
}
