// A change of preset that makes the safety gate act is undone by the servo itself, and a harmless one never is: the
// simulated hand at 1 kHz, on several meshes.
#include "core/lab/objects/generate.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/workbench/session/guard_fixture.h"
#include "workbench/session/bookmarks.h"
#include "workbench/session/safe_range/safe_sweep.h"
#include "workbench/session/safety_log.h"
#include "workbench/session/session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Spot, 5,856 triangles, as large as a fist: a body with limbs, as the bunny.
ScenePtr spot_scene() {
  static const ScenePtr scene = [] {
    auto mesh = read_mesh(tangent::testing::spot_file(), 1.0);
    REQUIRE(mesh);
    ContactMeshOptions options;
    options.fit_m = 0.08;
    return scene_of(*mesh, options);
  }();
  return scene;
}

struct Body {
  const char* name;
  ScenePtr scene;
};
std::vector<Body> bodies() {
  static const ScenePtr cube = scene_of(*generate_mesh("cube"));
  return {{"torus", torus_scene()}, {"cube", cube}, {"spot", spot_scene()}};
}

Preset stiff(double n_per_m) {
  Preset preset = GuardBench::soft();
  preset.force.stiffness_n_per_m = n_per_m;
  return preset;
}

}  // namespace

TEST_CASE("a change that makes the gate act is undone within 5 ticks, on torus, cube and a body with limbs") {
  for (const Body& body : bodies()) {
    for (const double n_per_m : {16e3, 40e3}) {
      CAPTURE(body.name);
      CAPTURE(n_per_m);
      GuardBench b(body.scene);
      const Preset bad = stiff(n_per_m);
      b.change(bad);
      std::uint64_t changed = 0, limited = 0, acted = 0, back = 0;
      int row = 0;  // ticks in a row in which the force was limited
      ServoRecord r;
      for (int i = 0; i < 6000 && back == 0; ++i) {
        r = b.bench.run();
        if (changed == 0) changed = r.tick.tick;
        row = gate_did(r, GateAction::slew_limited) ? row + 1 : 0;
        if (row == 1) limited = r.tick.tick;
        if (acted == 0 && gate_did(r, GateAction::preset_undone)) acted = r.tick.tick;
        if (acted != 0 && r.tick.preset_id == 0) back = r.tick.tick;
      }
      REQUIRE(acted != 0);
      REQUIRE(back != 0);
      const PresetUndone undone = b.undone();
      MESSAGE(std::string(body.name) << " " << n_per_m << " N/m: " << to_text(undone) << ", " << acted - changed
                                     << " ticks after the change, undone " << back - acted << " tick after");
      CHECK(back - acted <= 5);
      if (undone.why == UndoneBecause::limited) CHECK(back - limited <= 5);
      CHECK(undone.tick == acted);
      CHECK(undone.bad_id == 1);
      CHECK(undone.good_id == 0);
      CHECK(undone.count == 1);
    }
  }
}

TEST_CASE("after it was undone without a stop the hand is calm again, and the force came back without a step") {
  GuardBench b(torus_scene());
  b.change(stiff(16e3));
  double most_change_n = 0.0;
  Vec3 last(0.0);
  std::uint64_t acted = 0;
  ServoRecord r;
  for (int i = 0; i < 9000; ++i) {
    r = b.bench.run();
    if (gate_did(r, GateAction::preset_undone)) acted = r.tick.tick;
    if (acted != 0) most_change_n = std::max(most_change_n, glm::length(r.device.force_command_n - last));
    last = r.device.force_command_n;
    if (acted != 0 && r.tick.tick > acted + 1500) break;
  }
  REQUIRE(acted != 0);
  const PresetUndone undone = b.undone();
  MESSAGE(to_text(undone) << "; largest change of the force in a tick after it: " << most_change_n << " N");
  CHECK(undone.why != UndoneBecause::stopped);
  CHECK(r.device.gate_state == GateState::armed);
  CHECK(r.tick.preset_id == 0);
  CHECK(most_change_n <= 2.0 + 1e-9);  // the gate's slew limit
}

TEST_CASE("each thing that the gate does counts by itself, and what a preset can't cause does not") {
  const GateOutput armed{.force_n = Vec3(1.0, 0.0, 0.0), .state = GateState::armed};
  const auto on_trial = [&](PresetGuard& guard, const PresetLetter& good, const PresetLetter& bad) {
    static_cast<void>(guard.watch(armed, {}, good, 0, 1e-3));
    CHECK(guard.take(bad, good, true));
    REQUIRE(guard.on_trial());
  };
  const PresetLetter good{3, GuardBench::soft(), true}, bad{4, stiff(900.0), true};
  for (const GateFault fault :
       {GateFault::shaking, GateFault::position_jumped, GateFault::display_jumped, GateFault::force_not_finite,
        GateFault::late_tick, GateFault::force_device, GateFault::stale_sample, GateFault::exchange_hung}) {
    CAPTURE(to_string(fault));
    PresetGuard guard;
    on_trial(guard, good, bad);
    const PresetLetter* back = guard.watch({.state = GateState::faulted, .fault = fault}, {}, bad, 7, 1e-3);
    const bool by_preset = fault <= GateFault::display_not_finite || fault == GateFault::position_jumped ||
                           fault == GateFault::display_jumped || fault == GateFault::shaking;
    CHECK((back != nullptr) == by_preset);
    if (back != nullptr) CHECK(back->id == 3);
    CHECK(guard.undone().why == (by_preset ? UndoneBecause::stopped : UndoneBecause::none));
  }
  PresetGuard guard;
  on_trial(guard, good, bad);
  EnergyWatch energy;
  EnergyWatch::Step step;
  step.force_n = Vec3(1.0, 0.0, 0.0);
  step.moved_m = Vec3(20e-6, 0.0, 0.0);  // 20 mW
  int ticks = 0;
  bool stops = false;
  const PresetLetter* back = nullptr;
  for (; back == nullptr && !stops && ticks < 2000; ++ticks) {
    stops = energy.add(step);
    back = guard.watch(armed, energy, bad, 0, 1e-3);
  }
  MESSAGE("20 mW: undone after " << ticks << " ticks, before the gate stops");
  CHECK(back != nullptr);
  CHECK_FALSE(stops);
  CHECK(guard.undone().why == UndoneBecause::energy);
}

TEST_CASE(
    "a display that stands still is the doing of its controller's values, and late ticks of a solver that overran") {
  const GateOutput armed{.force_n = Vec3(1.0, 0.0, 0.0), .state = GateState::armed};
  const PresetLetter good{3, GuardBench::soft(), true};
  PresetLetter stiffer{4, stiff(900.0), true}, slower{5, GuardBench::soft(), true};
  slower.preset.controller.p_per_s2 = 10.0;
  const auto taken_back = [&](const PresetLetter& bad, GateFault fault, int overran) {
    PresetGuard guard;
    static_cast<void>(guard.watch(armed, {}, good, 0, 1e-3, true));  // before the change: not its doing
    CHECK(guard.take(bad, good, true));
    for (int i = 0; i < 10; ++i) static_cast<void>(guard.watch(armed, {}, bad, 0, 1e-3, i < overran));
    return guard.watch({.state = GateState::faulted, .fault = fault}, {}, bad, 7, 1e-3) != nullptr;
  };
  for (const GateFault fault : {GateFault::display_frozen, GateFault::contact_display}) {
    CHECK(taken_back(slower, fault, 0));
    CHECK_FALSE(taken_back(stiffer, fault, 0));
  }
  CHECK_FALSE(taken_back(stiffer, GateFault::late_tick, 0));
  CHECK(taken_back(stiffer, GateFault::late_tick, 1));
  CHECK_FALSE(taken_back(stiffer, GateFault::late_ticks, 2));
  CHECK(taken_back(stiffer, GateFault::late_ticks, 3));
}

namespace {
std::int64_t made_up_ns = 0, solve_takes_ns = 0;
std::int64_t made_up_clock() noexcept { return made_up_ns += solve_takes_ns; }
}  // namespace

TEST_CASE("a change that makes ticks longer than the servo's period is undone in the tick after the gate stops") {
  for (const bool slow : {false, true}) {
    CAPTURE(slow);
    DeviceSet devices = GuardBench::set(lively(), false);
    ServoChannels channels(4096);
    ServoStatistics statistics;
    const Preset soft = GuardBench::soft();
    solve_takes_ns = 1000;
    ServoTick tick(devices, channels, statistics, std::make_unique<PreparedScene>(torus_scene(), soft.finger),
                   PresetLetter{0, soft}, made_up_clock);
    channels.force.put(ForceSwitch::arm);
    TickTiming timing;
    timing.dt_s = 1e-3;
    ServoRecord r;
    const auto run = [&](double dt_s) {
      timing.dt_s = dt_s;
      timing.t_s += dt_s;
      tick.run(timing);
      REQUIRE(channels.gui.pop(r));
    };
    for (int i = 0; i < 1500; ++i) run(1e-3);
    REQUIRE(r.device.gate_state == GateState::armed);
    channels.presets.put({1, stiff(500.0), true, 0});
    solve_takes_ns = slow ? 2'500'000 : 1000;
    std::uint64_t stopped = 0, back = 0;
    for (int i = 0; i < 60 && back == 0; ++i) {
      run(3e-3);  // late either way: another process has the processor, or the solver takes so long
      if (stopped == 0 && r.device.gate_state == GateState::faulted) stopped = r.tick.tick;
      if (stopped != 0 && r.tick.preset_id == 0) back = r.tick.tick;
    }
    REQUIRE(stopped != 0);
    CHECK(r.device.gate_fault == GateFault::late_ticks);
    CHECK((back != 0) == slow);
    if (slow) CHECK(back - stopped <= 5);
  }
}

TEST_CASE("a change that was in contact for its time is known good, and is what the next one goes back to") {
  const GateOutput armed{.force_n = Vec3(1.0, 0.0, 0.0), .state = GateState::armed};
  GateOutput in_air = armed;
  in_air.force_n = Vec3(0.0);
  const PresetLetter first{0, GuardBench::soft(), true}, second{1, stiff(900.0), true}, third{2, stiff(1000.0), true};
  PresetGuard guard;
  static_cast<void>(guard.watch(armed, {}, first, 0, 1e-3));
  CHECK(guard.take(second, first, true));
  for (int i = 0; i < 5000; ++i) static_cast<void>(guard.watch(in_air, {}, second, 0, 1e-3));
  CHECK(guard.on_trial());
  for (int i = 0; i < 2001; ++i) static_cast<void>(guard.watch(armed, {}, second, 0, 1e-3));
  CHECK_FALSE(guard.on_trial());
  CHECK(guard.take(third, second, true));
  GateOutput limited = armed;
  limited.actions = 1u << static_cast<unsigned>(GateAction::slew_limited);
  const PresetLetter* back = nullptr;
  for (int i = 0; i < 10 && back == nullptr; ++i) back = guard.watch(limited, {}, third, 0, 1e-3);
  REQUIRE(back != nullptr);
  CHECK(back->id == 1);
  CHECK_FALSE(guard.take({3, stiff(2000.0), true, 0}, *back, true));
  CHECK(guard.take({3, stiff(2000.0), true, 1}, *back, true));
}

TEST_CASE("letters sent before their sender knew are dropped, and those after count") {
  GuardBench b(torus_scene());
  b.change(stiff(20e3));
  ServoRecord r;
  do r = b.bench.run();
  while (!gate_did(r, GateAction::preset_undone) && r.tick.tick < 8000);
  REQUIRE(gate_did(r, GateAction::preset_undone));
  b.change(stiff(30e3));  // a slider that is still being dragged
  r = b.bench.run(3);
  CHECK(r.tick.preset_id == 0);
  REQUIRE(b.undone().count == 1);
  b.change(stiff(500.0));
  r = b.bench.run(3);
  CHECK(r.tick.preset_id == 3);
}

TEST_CASE("a person's stop, a fault of the device and a change while disarmed undo nothing") {
  for (const int what : {0, 1, 2}) {
    CAPTURE(what);
    GuardBench b(torus_scene());
    if (what == 2) {
      b.bench.channels.stop.store(true);
      b.bench.run(5);
    }
    b.change(stiff(what == 2 ? 20e3 : 500.0));
    b.bench.run(20);
    if (what == 0) b.bench.channels.stop.store(true);
    if (what == 1) b.bench.channels.faults.put({{InjectedFault::drop_out, 50}, false});
    bool any = false;
    for (int i = 0; i < 2000; ++i) any = any || gate_did(b.bench.run(), GateAction::preset_undone);
    CHECK_FALSE(any);
    CHECK(b.undone().count == 0);
  }
}

TEST_CASE("unguarded changes are not undone, whatever the gate does") {
  GuardBench b(torus_scene());
  b.bench.channels.presets.put({1, stiff(20e3)});
  ServoRecord r;
  bool any = false;
  for (int i = 0; i < 3000; ++i) {
    r = b.bench.run();
    any = any || gate_did(r, GateAction::preset_undone);
  }
  CHECK_FALSE(any);
  CHECK(r.tick.preset_id == 1);
}

TEST_CASE("100 changes inside the safe ranges are all kept" * doctest::skip(testing::kSanitized)) {
  const PresetKey *stiffness = find_preset_key("force.stiffness_n_per_m"),
                  *damping = find_preset_key("force.damping_n_s_per_m");
  int changes = 0, wanted_changes = 0;
  std::vector<Body> all = bodies();
  if (rounds(20) < 20) all = {all[1]};  // in debug builds: the sweeps of all three take minutes there
  for (const Body& body : all) {
    CAPTURE(body.name);
    SimulatedForceOptions options;  // as the program simulates it
    const Preset base;
    SafeSweep sweep;
    const bool torus = body.scene == torus_scene();
    sweep.start({body.scene, {}}, base, torus ? std::vector{stiffness, damping} : std::vector{stiffness}, 1);
    sweep.wait();
    GuardBench b(body.scene, options, base);
    std::mt19937_64 random(17);
    const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const int count = rounds(torus ? 40 : 30);
    wanted_changes += count;
    for (int i = 0; i < count;) {
      const PresetKey& key = torus && i % 2 != 0 ? *damping : *stiffness;
      const SafeRange range = sweep.range(key);
      REQUIRE(!range.samples().empty());
      Preset wanted = base;
      const double low = range.samples().front().value, high = range.samples().back().value;
      key.set(wanted, low + share() * (high - low));
      if (sweep.known(wanted).safety != Safety::stable) continue;
      b.change(wanted);
      bool any = false;
      for (int tick = 0; tick < 300; ++tick) any = any || gate_did(b.bench.run(), GateAction::preset_undone);
      CHECK_FALSE(any);
      ++i;
      ++changes;
    }
    CHECK(b.undone().count == 0);
    CHECK(b.bench.run().device.gate_state == GateState::armed);
  }
  MESSAGE(changes << " changes, none undone");
  CHECK(changes == wanted_changes);
}

TEST_CASE("a session goes back by itself, under an id of its own, and history, log and bookmarks say so") {
  DeviceSet devices;
  SimulatedForceOptions options = lively();
  options.hand_damping_n_s_per_m = 0.8;
  options.hand_mass_kg = 0.02;
  devices.force = std::make_unique<SimulatedForceDevice>(options);
  SessionOptions wanted;
  wanted.threaded = false;
  wanted.hand.press_m = 6e-3;
  auto made = Session::create(torus_scene(), GuardBench::soft(), wanted, std::move(devices));
  REQUIRE(made);
  Session& session = **made;
  REQUIRE(session.start());
  session.advance(1500);
  REQUIRE(session.status().servo.gate_state == GateState::armed);
  session.guard_presets(true);
  const auto bad = session.set_preset(stiff(3500.0));
  REQUIRE(bad);
  for (int i = 0; i < 100 && session.preset_undone().count == 0; ++i) session.advance(100);
  REQUIRE(session.preset_undone().count == 1);
  CHECK(session.preset_undone().bad_id == *bad);
  CHECK(session.preset() == GuardBench::soft());
  CHECK(session.preset_id() == *bad + 1);
  session.advance(50);
  CHECK(session.history().newest().tick.preset_id == session.preset_id());
  CHECK(session.status().servo.gate_counts[static_cast<std::size_t>(GateAction::preset_undone)] == 1);
  const auto& log = session.safety_log().entries();
  CHECK(std::any_of(log.begin(), log.end(), [](const SafetyEntry& e) { return e.text == "preset undone"; }));
  Bookmarks marks;
  for (std::size_t i = 0; i < session.history().size(); ++i) marks.watch(session.history()[i]);
  const auto& all = marks.all();
  CHECK(std::any_of(all.begin(), all.end(),
                    [](const Bookmark& m) { return m.note.find("undone") != std::string::npos; }));
  const auto next = session.set_preset(stiff(450.0));
  REQUIRE(next);
  session.advance(20);
  CHECK(session.history().newest().tick.preset_id == *next);
}
