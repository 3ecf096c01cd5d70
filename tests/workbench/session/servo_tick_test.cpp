#include "workbench/session/servo_tick.h"

#include "devices/simulated/simulated_contact_display.h"
#include "devices/simulated/simulated_force_device.h"
#include "tests/support/approx.h"
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

const Vec3 kLifted(0.0, 0.0, 0.0605), kPressed(0.0, 0.0, 0.059);

/// A puppet that holds the finger 1 mm deep in the sphere: a force of 0.8 N with the default preset. To be armed the
/// finger is lifted.
struct PressedBench {
  PuppetForceDevice* device = new PuppetForceDevice;
  TickBench bench;

  PressedBench() : bench(with(device), sphere_scene()) { device->position = kPressed; }
  static DeviceSet with(PuppetForceDevice* puppet) {
    DeviceSet set;
    set.force.reset(puppet);
    return set;
  }
  void run_until_armed() {
    device->position = kLifted;
    bench.arm();
    bench.run(400);
    device->position = kPressed;
    const ServoRecord record = bench.run(100);
    REQUIRE(record.device.gate_state == GateState::armed);
    REQUIRE(glm::length(device->commands.back().force_n) > 0.5);
  }
};

void open(const DeviceSet& set) {
  if (set.force) REQUIRE(set.force->open());
  if (set.display) REQUIRE(set.display->open());
}

std::vector<ServoRecord> simulated_run(std::uint64_t seed, int ticks) {
  TickBench bench(simulated(seed), torus_scene());
  open(bench.devices);
  bench.arm();
  std::vector<ServoRecord> records;
  for (int i = 0; i < ticks; ++i) records.push_back(bench.run());
  return records;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("simulated devices home, arm, and the finger comes to rest in the surface") {
  TickBench bench(simulated(), sphere_scene());
  open(bench.devices);
  bench.arm();
  bool homing = false;
  for (int i = 0; i < 300; ++i) {
    const ServoRecord r = bench.run();
    homing = homing || r.device.force_state == DeviceState::homing;
    if (r.device.force_state != DeviceState::ready || r.device.display_state != DeviceState::ready) {
      CHECK(r.device.force_command_n == Vec3(0.0));
      CHECK(r.device.force_rendered_n == Vec3(0.0));
    }
  }
  CHECK(homing);
  bench.run(1000);
  int off = 0;
  for (int i = 0; i < 3000; ++i) {
    const ServoRecord r = bench.run();
    CHECK(r.tick.output.status == TickStatus::face);
    CHECK(r.device.gate_state == GateState::armed);
    off += r.tick.output.penetration_m < 0.5e-3 || r.tick.output.penetration_m > 1e-3;
  }
  CHECK(off < 30);
}

TEST_CASE("the command of a tick is rendered during the exchange of the next") {
  TickBench bench(simulated(), sphere_scene());
  open(bench.devices);
  bench.arm();
  ServoRecord last = bench.run(1500);
  for (int i = 0; i < 100; ++i) {
    const ServoRecord r = bench.run();
    CHECK(r.device.force_rendered_n == last.device.force_command_n);
    last = r;
  }
}

TEST_CASE("the same seed gives the same records, bit by bit") {
  const auto a = simulated_run(5, 3000), b = simulated_run(5, 3000), c = simulated_run(6, 3000);
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same = same_bits(a[i].tick.input.finger.position, b[i].tick.input.finger.position) &&
                      same_bits(a[i].tick.output.force_n, b[i].tick.output.force_n) &&
                      same_bits(a[i].tick.output.cld_m, b[i].tick.output.cld_m) &&
                      same_bits(a[i].tick.output.error_m, b[i].tick.output.error_m) &&
                      same_bits(a[i].device.force_command_n, b[i].device.force_command_n) &&
                      same_bits(a[i].device.cld_measured_m, b[i].device.cld_measured_m) &&
                      a[i].tick.tick == b[i].tick.tick && a[i].device.gate_actions == b[i].device.gate_actions;
    REQUIRE(same);
    differs = differs || a[i].tick.input.finger.position != c[i].tick.input.finger.position;
  }
  CHECK(differs);
}

TEST_CASE("a preset is applied whole at the next tick, and the record says which one ran") {
  PressedBench p;
  p.run_until_armed();
  CHECK(p.bench.run().tick.preset_id == 0);
  const double before = glm::length(p.bench.run().tick.output.decided_force_n);
  Preset stiff;
  stiff.force.stiffness_n_per_m *= 2.0;
  p.bench.channels.presets.put({7, stiff});
  const ServoRecord r = p.bench.run();
  CHECK(r.tick.preset_id == 7);
  CHECK(glm::length(r.tick.output.decided_force_n) == approx(2.0 * before).epsilon(1e-6));
  CHECK(glm::length(r.tick.output.force_n) < 1.1 * before);  // faded in
}

TEST_CASE("a preset's gains and limits reach the display's controller, from the first and under way") {
  Preset first;
  first.controller = {.p_per_s2 = 3000.0, .i_per_s3 = 20000.0, .d_per_s = 60.0};
  TickBench bench(simulated(1), torus_scene(), first);
  open(bench.devices);
  const CldMechanism& mechanism = static_cast<SimulatedContactDisplay&>(*bench.devices.display).mechanism();
  CHECK(mechanism.gains().p_per_s2 == 3000.0);
  CHECK(mechanism.gains().i_per_s3 == 20000.0);
  bench.arm();
  bench.run(600);
  Preset second = first;
  second.controller = {.lowest_m = -1e-3, .highest_m = 1e-3};
  bench.channels.presets.put({1, second});
  bool clamped = false;
  for (int i = 0; i < 3000; ++i) {
    const ServoRecord r = bench.run();
    // Comes back from where it was at the speed that targets may have.
    REQUIRE(std::abs(r.device.cld_command_m) <= std::max(1e-3, 10e-3 - 0.25e-3 * i));
    clamped = clamped || ((r.device.gate_actions >> static_cast<unsigned>(GateAction::display_clamped)) & 1u) != 0;
    REQUIRE(r.device.gate_fault == GateFault::none);  // the roller follows what it is sent
  }
  CHECK(clamped);
  CHECK(mechanism.gains().p_per_s2 == CldMechanism().gains().p_per_s2);
}

TEST_CASE("nothing is commanded before arming, after a stop, or after release") {
  PressedBench p;
  p.bench.run(100);
  for (const ForceCommand& c : p.device->commands) CHECK(c.force_n == Vec3(0.0));
  p.run_until_armed();
  p.bench.channels.force.put(ForceSwitch::stop);
  CHECK(p.bench.run().device.force_command_n == Vec3(0.0));
  p.bench.run();
  CHECK(p.device->commands.back().force_n == Vec3(0.0));
  p.run_until_armed();
  p.bench.tick->release(1e-3);
  CHECK(p.device->commands.back().force_n == Vec3(0.0));
  CHECK(p.device->commands.back().request == DeviceRequest::stop);
}

TEST_CASE("a device fault stops the force within two ticks, and only arming brings it back") {
  PressedBench p;
  p.run_until_armed();
  p.device->state = DeviceState::faulted;
  const ServoRecord r = p.bench.run();
  CHECK(r.device.gate_fault == GateFault::force_device);
  CHECK(r.device.force_command_n == Vec3(0.0));
  p.bench.run();
  CHECK(p.device->commands.back().force_n == Vec3(0.0));
  CHECK(p.device->commands.back().request == DeviceRequest::none);  // no clearing without a person

  p.device->state = DeviceState::ready;
  for (int i = 0; i < 50; ++i) CHECK(p.bench.run().device.force_command_n == Vec3(0.0));
  p.run_until_armed();
}

TEST_CASE("every fault of the simulated devices stops the force within two ticks - arming homes them again") {
  for (const DeviceFault fault : {DeviceFault::disconnected, DeviceFault::sensor, DeviceFault::actuator}) {
    for (const bool display : {false, true}) {
      CAPTURE(to_string(fault));
      CAPTURE(display);
      TickBench bench(simulated(), sphere_scene());
      open(bench.devices);
      bench.arm();
      REQUIRE(glm::length(bench.run(1500).device.force_rendered_n) > 0.3);
      if (display)
        static_cast<SimulatedContactDisplay&>(*bench.devices.display).inject(fault);
      else
        static_cast<SimulatedForceDevice&>(*bench.devices.force).inject(fault);
      const ServoRecord first = bench.run();
      CHECK(first.device.gate_state == GateState::faulted);
      CHECK((display ? first.device.display_fault : first.device.force_fault) == fault);
      CHECK(first.device.force_command_n == Vec3(0.0));
      CHECK(bench.run().device.force_rendered_n == Vec3(0.0));

      bench.arm();
      const ServoRecord again = bench.run(1500);
      CHECK(again.device.gate_state == GateState::armed);
      CHECK(glm::length(again.device.force_rendered_n) > 0.3);
    }
  }
}

TEST_CASE("a position that is not finite sends no force that is not finite") {
  PressedBench p;
  p.run_until_armed();
  p.device->position = Vec3(0.0, std::numeric_limits<double>::quiet_NaN(), 0.059);
  for (int i = 0; i < 20; ++i) {
    const ServoRecord r = p.bench.run();
    CHECK(is_finite(r.device.force_command_n));
    CHECK(r.tick.output.status == TickStatus::unconverged);
  }
  p.bench.run();
  CHECK(p.device->commands.back().force_n == Vec3(0.0));  // hold and ramp are over
}

TEST_CASE("without a force device the finger goes where the hand wants it, and there is no force") {
  DeviceSet set = simulated();
  set.force.reset();
  open(set);
  TickBench bench(std::move(set), sphere_scene());
  bench.arm();
  bench.run(1000);
  for (int i = 0; i < 100; ++i) {
    const ServoRecord r = bench.run();
    CHECK(r.tick.input.finger.position == r.device.hand_target_m);
    CHECK(r.device.force_command_n == Vec3(0.0));
    CHECK(r.device.force_state == DeviceState::absent);
    CHECK(r.device.display_state == DeviceState::ready);
  }
}

TEST_CASE("a new scene is taken at the next tick, the old one comes back, and the force ramps in anew") {
  TickBench bench(simulated(), sphere_scene());
  open(bench.devices);
  bench.arm();
  REQUIRE(bench.run(1500).device.gate_state == GateState::armed);
  auto torus = scene_of(make_torus(0.030, 0.012, 24, 12));
  std::weak_ptr<const ContactScene> watch = torus;
  auto prepared = std::make_unique<PreparedScene>(torus, Finger{});
  prepared->id = 3;
  torus.reset();
  bench.channels.scenes.offer(std::move(prepared));
  const ServoRecord r = bench.run();
  CHECK(r.scene_id == 3);
  CHECK(r.device.gate_state == GateState::ramping);
  CHECK(r.tick.kept.plane.feature == Feature::none);
  CHECK(bench.run(1500).device.gate_state == GateState::armed);

  // Replaced again: the servo gives it back, and it is freed by whoever collects.
  bench.channels.scenes.offer(std::make_unique<PreparedScene>(sphere_scene(), Finger{}));
  bench.run();
  CHECK_FALSE(watch.expired());
  bench.channels.scenes.collect();
  CHECK(watch.expired());
}

TEST_CASE("a scene that is replaced before the servo takes it is freed by the owner") {
  TickBench bench(simulated(), sphere_scene());
  auto scene = scene_of(make_torus(0.030, 0.012, 24, 12));
  std::weak_ptr<const ContactScene> watch = scene;
  bench.channels.scenes.offer(std::make_unique<PreparedScene>(std::move(scene), Finger{}));
  bench.channels.scenes.offer(std::make_unique<PreparedScene>(sphere_scene(), Finger{}));
  CHECK(watch.expired());
}

TEST_CASE("a recorder gets every record while attached, and none before or after") {
  PressedBench p;
  ServoRecord record;
  p.bench.run(5);
  CHECK_FALSE(p.bench.channels.recorder.pop(record));
  p.bench.channels.recorder_attached = true;
  p.bench.run(3);
  p.bench.channels.recorder_attached = false;
  p.bench.run(2);
  for (std::uint64_t tick = 5; tick < 8; ++tick) {
    REQUIRE(p.bench.channels.recorder.pop(record));
    CHECK(record.tick.tick == tick);
  }
  CHECK_FALSE(p.bench.channels.recorder.pop(record));
}

TEST_CASE(
    "a velocity that the device measures reaches the tick and damps, and without one it is that of the positions") {
  PressedBench pressed;
  Preset preset;
  preset.force.damping_n_s_per_m = 5.0;
  pressed.bench.channels.presets.put({7, preset});
  CHECK_FALSE(pressed.bench.run(50).tick.input.velocity.has_value());
  CHECK(pressed.bench.run().tick.output.force_n.z == approx(0.8));
  pressed.device->velocity = Vec3(0.0, 0.0, -0.02);
  const ServoRecord record = pressed.bench.run(50);
  REQUIRE(record.tick.input.velocity.has_value());
  CHECK(*record.tick.input.velocity == Vec3(0.0, 0.0, -0.02));
  CHECK(record.tick.output.decided_force_n.z == approx(0.9));
}

TEST_CASE("a stop that a tick takes is in that tick's exchange, and so is a stall before it") {
  PressedBench stopped;
  stopped.run_until_armed();
  stopped.bench.channels.force.put(ForceSwitch::stop);
  stopped.bench.run();
  CHECK(stopped.device->commands.back().force_n == Vec3(0.0));

  PressedBench homed;
  homed.run_until_armed();
  homed.bench.channels.force.put(ForceSwitch::home);
  homed.bench.run();
  CHECK(homed.device->commands.back().force_n == Vec3(0.0));

  PressedBench stalled;
  stalled.run_until_armed();
  TickTiming late = stalled.bench.pacer.begin(stalled.bench.pacer.deadline_ns());
  late.dt_s = 30e-3;
  stalled.bench.tick->run(late);
  CHECK(stalled.device->commands.back().force_n == Vec3(0.0));
  ServoRecord record;
  REQUIRE(stalled.bench.channels.gui.pop(record));
  CHECK(record.device.gate_fault == GateFault::late_tick);
}

TEST_CASE("simulated devices arm and run from 100 Hz to 10 kHz") {
  for (const double rate : {100.0, 500.0, 1000.0, 4000.0, 10'000.0}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(rate);
      Preset soft;
      soft.force.stiffness_n_per_m = 500.0;  // stable at 100 Hz, too
      TickBench bench(simulated(seed), torus_scene(), soft, rate);
      open(bench.devices);
      bench.arm();
      const auto ticks = static_cast<int>(3.0 * rate);
      const ServoRecord last = bench.run(ticks);
      CHECK(last.device.gate_state == GateState::armed);
      CHECK(last.device.gate_fault == GateFault::none);
      CHECK(glm::length(last.device.force_command_n) > 0.1);
    }
  }
}

TEST_CASE("what every method renders on the way over a torus and a cube is not taken for shaking") {
  const auto cube = scene_of(*generate_mesh("cube"));
  for (const auto& scene : {torus_scene(), cube}) {
    for (const Method method :
         {Method::paper, Method::newton, Method::robust, Method::facet, Method::force_shading, Method::two_pass}) {
      for (const double stiffness : {800.0, 2500.0}) {
        CAPTURE(std::string(to_string(method)));
        CAPTURE(stiffness);
        Preset preset;
        preset.solver.method = method;
        preset.force.stiffness_n_per_m = stiffness;
        preset.force.damping_n_s_per_m = stiffness > 1000.0 ? 2.0 : 0.0;
        TickBench bench(simulated(), scene, preset);
        open(bench.devices);
        HandCommand hand;
        hand.settings.speed_m_per_s = 0.15;
        hand.settings.press_m = 5e-3;
        bench.channels.hand.put(hand);
        bench.arm();
        double most_j = 0.0;
        ServoRecord r;
        for (int i = 0; i < 8000; ++i) {
          r = bench.run();
          most_j = std::max(most_j, r.device.energy_j);
        }
        MESSAGE(std::string(to_string(method)) << ", " << stiffness << " N/m: at most " << most_j * 1e3 << " mJ made");
        CHECK(r.device.gate_fault == GateFault::none);
      }
    }
  }
}

TEST_CASE("a stiffer preset in contact declares what it stores, and leaving it afterwards is no shaking") {
  for (const auto& [from, to] : {std::pair{100.0, 3500.0}, std::pair{3500.0, 100.0}, std::pair{800.0, 2000.0}}) {
    CAPTURE(from);
    CAPTURE(to);
    Preset preset;
    preset.force.stiffness_n_per_m = from;
    TickBench bench(simulated(), sphere_scene(), preset);
    open(bench.devices);
    HandCommand hand;
    hand.settings.mode = HandMode::point;
    hand.point_m = Vec3(0, 0, 0.040 + preset.finger.radius_m - 3e-3);
    bench.channels.hand.put(hand);
    bench.arm();
    bench.run(2500);
    preset.force.stiffness_n_per_m = to;
    bench.channels.presets.put({1, preset});
    bench.run(2500);
    hand.point_m.z += 20e-3;
    bench.channels.hand.put(hand);
    CHECK(bench.run(1500).device.gate_fault == GateFault::none);
  }
}

TEST_CASE("motors stay hot when their device is closed and opened again") {
  const auto a_bench = [](double& force_n) {
    auto* device = new PuppetForceDevice;
    device->caps.name = "arm of the heat test";
    device->caps.continuous_force_n = 1.4;
    device->position = Vec3(0, 0, 0.061);
    TickBench bench(PressedBench::with(device), sphere_scene());
    bench.arm();
    bench.run(400);
    // Deep, for peak force, and slower and slower: a finger that stops at once reads as a stuck encoder.
    for (double& z = device->position.z; z > 0.0401; z -= 0.01 * (z - 0.040)) bench.run();
    force_n = glm::length(device->commands.back().force_n);
    bench.run(3000);
  };
  double first_n = 0.0, second_n = 0.0;
  a_bench(first_n);
  a_bench(second_n);
  CHECK(first_n > 8.0);
  CHECK(second_n < 3.0);
}

TEST_CASE("the display's target moves no faster than its limit, whatever the contact does") {
  TickBench bench(simulated(), torus_scene());
  open(bench.devices);
  HandCommand hand;
  hand.settings.speed_m_per_s = 0.5;
  bench.channels.hand.put(hand);
  bench.arm();
  double last = 0.0, fastest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 1500 == 1499) bench.channels.scenes.offer(std::make_unique<PreparedScene>(sphere_scene(), Finger{}));
    const ServoRecord r = bench.run();
    fastest = std::max(fastest, std::abs(r.device.cld_command_m - last) / 1e-3);
    last = r.device.cld_command_m;
  }
  CHECK(fastest <= 0.25 * (1.0 + 1e-9));
}

namespace {

std::int64_t latency_clock_ns = 0;
std::int64_t read_latency_clock() noexcept { return latency_clock_ns; }

}  // namespace

TEST_CASE("a command says how old the finger's position in it is") {
  latency_clock_ns = 1'000'000;
  auto* device = new PuppetForceDevice;
  device->position = Vec3(0, 0, 0.062);
  device->before = [](PuppetForceDevice&) { latency_clock_ns += 40'000; };  // an exchange takes 40 us
  DeviceSet devices;
  devices.force.reset(device);
  ServoChannels channels(16);
  ServoStatistics statistics;
  ServoTick tick(devices, channels, statistics, std::make_unique<PreparedScene>(sphere_scene(), Finger{}),
                 PresetLetter{}, read_latency_clock, 1000.0);
  DeadlinePacer pacer(1000.0, false);
  pacer.start(0);
  ServoRecord record;
  tick.run(pacer.begin(pacer.deadline_ns()));
  REQUIRE(channels.gui.pop(record));
  CHECK(record.latency_ns == 0.0);  // nothing was known of the finger
  for (int i = 0; i < 3; ++i) {
    latency_clock_ns += 960'000;
    tick.run(pacer.begin(pacer.deadline_ns()));
    REQUIRE(channels.gui.pop(record));
    CHECK(record.latency_ns == 960'000.0);  // from the end of the exchange that brought it
  }
  CHECK(statistics.latency_ns().count() == 3);
}
