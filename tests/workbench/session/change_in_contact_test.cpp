// What a change in contact does to the finger: a real device (nobody lifts the finger or places it anew), held by the
// simulated hand. Preset, method, condition and mesh change under it; the finger leaves at under 0.1 m/s.
#include "core/io/rendering_condition.h"
#include "devices/simulated/held_device.h"
#include "tests/support/approx.h"
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kFastestLeaving = 0.1;  // m/s
constexpr double kTouch = 0.060;         // m from the sphere's centre, of the finger's

struct Felt {
  double fastest_out = 0.0;    ///< m/s, away from the centre
  double fastest = 0.0;        ///< m/s, anywhere
  double most_change_n = 0.0;  ///< of the force sent, in 5 ms
  double end_n = 0.0;          ///< the force at the end
  double decided_end_n = 0.0;  ///< as decided
};

struct Hold {
  HeldDevice* device;
  TickBench bench;

  Hold(const Preset& preset, double mass_kg = 0.1, std::shared_ptr<const ContactScene> scene = sphere_scene())
      : device(new HeldDevice(options(mass_kg))), bench(set(device), std::move(scene), preset) {
    REQUIRE(device->open());
    aim(kTouch + 1e-3);
    device->inner.place(target_);
    bench.arm();
    REQUIRE(bench.run(600).device.gate_state == GateState::armed);
  }
  static SimulatedForceOptions options(double mass_kg) {
    SimulatedForceOptions o;
    o.hand_mass_kg = mass_kg;
    o.tremor_m = o.friction_n = 0.0;
    return o;
  }
  static DeviceSet set(HeldDevice* device) {
    DeviceSet s;
    s.force.reset(device);
    return s;
  }
  void aim(double z) {
    target_.position_m = Vec3(0.0, 0.0, z);
    device->inner.lead(target_);
  }
  /// Presses slowly until the finger's centre is `depth_m` in, by aiming deeper.
  void press(double depth_m) {
    for (double z = kTouch + 1e-3; device->inner.exact_position_m().z > kTouch - depth_m && z > 0.0; z -= 5e-6) {
      aim(z);
      bench.run();
    }
    bench.run(600);
    REQUIRE(bench.run().device.gate_state == GateState::armed);
  }
  Felt watch(int ticks) {
    Felt out;
    std::vector<double> sent;
    ServoRecord r;
    for (int i = 0; i < ticks; ++i) {
      r = bench.run();
      REQUIRE(r.device.gate_fault == GateFault::none);
      const Vec3 v = device->inner.velocity_m_per_s();
      out.fastest = std::max(out.fastest, glm::length(v));
      out.fastest_out = std::max(out.fastest_out, v.z);
      sent.push_back(glm::length(r.device.force_command_n));
      if (sent.size() > 5)
        out.most_change_n = std::max(out.most_change_n, std::abs(sent.back() - sent[sent.size() - 6]));
    }
    out.end_n = glm::length(r.tick.output.force_n);
    out.decided_end_n = glm::length(r.tick.output.decided_force_n);
    return out;
  }
  void change(const Preset& preset) { bench.channels.presets.put({++id_, preset}); }

 private:
  HandTarget target_;
  std::uint32_t id_ = 0;
};

Preset with_stiffness(double n_per_m) {
  Preset preset;
  preset.force.stiffness_n_per_m = n_per_m;
  return preset;
}

void check_quiet(const char* what, const Felt& out) {
  MESSAGE(std::string(what) << ": leaves at " << out.fastest_out << " m/s, at most " << out.fastest << " m/s, "
                            << out.most_change_n << " N in 5 ms, " << out.end_n << " N at the end");
  CHECK(out.fastest < kFastestLeaving);
  CHECK(out.most_change_n < 1.0);
  CHECK(out.end_n == approx(out.decided_end_n).epsilon(0.02).scale(1e-3));
}

}  // namespace

TEST_CASE(
    "from 100 to 3500 N/m at 2.7 mm, and back, the finger leaves slowly, whatever it weighs and however it fades") {
  for (const double hand_kg : {0.0, 0.1, 0.4}) {
    for (const ForceBlend blend : {ForceBlend::events, ForceBlend::off}) {
      CAPTURE(hand_kg);
      Preset soft = with_stiffness(100.0), stiff = with_stiffness(3500.0);
      soft.force.blend = stiff.force.blend = blend;
      Hold hold(soft, hand_kg);
      hold.press(2.7e-3);
      hold.change(stiff);
      check_quiet("100 to 3500 N/m", hold.watch(2000));
      hold.change(soft);
      check_quiet("3500 to 100 N/m", hold.watch(2000));
    }
  }
}

TEST_CASE("presets that follow each other quickly, as by the key of A and B, add up to no kick") {
  Hold hold(with_stiffness(100.0));
  hold.press(2.7e-3);
  Felt worst;
  for (int i = 0; i < 40; ++i) {
    hold.change(with_stiffness(i % 2 == 0 ? 3500.0 : 100.0));
    const Felt out = hold.watch(10 + 7 * i);
    worst.fastest = std::max(worst.fastest, out.fastest);
    worst.fastest_out = std::max(worst.fastest_out, out.fastest_out);
  }
  MESSAGE("A and B: " << worst.fastest << " m/s");
  CHECK(worst.fastest < kFastestLeaving);
}

TEST_CASE("every method and condition changes into every other without a kick") {
  Felt worst;
  const auto note = [&](const Felt& out) {
    worst.fastest = std::max(worst.fastest, out.fastest);
    worst.most_change_n = std::max(worst.most_change_n, out.most_change_n);
  };
  Hold hold(with_stiffness(800.0));
  hold.press(2.0e-3);
  const std::array methods{Method::robust,   Method::facet,  Method::paper,
                           Method::two_pass, Method::newton, Method::force_shading};
  for (const Method a : methods) {
    for (const Method b : methods) {
      for (const Method m : {a, b}) {
        Preset preset = with_stiffness(800.0);
        preset.solver.method = m;
        hold.change(preset);
        note(hold.watch(150));
      }
    }
  }
  for (const RenderingCondition& condition : kRenderingConditions) {
    Preset preset = with_stiffness(800.0);
    set_condition(preset, condition);
    hold.change(preset);
    note(hold.watch(150));
  }
  MESSAGE("methods and conditions: " << worst.fastest << " m/s, " << worst.most_change_n << " N in 5 ms");
  CHECK(worst.fastest < kFastestLeaving);
}

TEST_CASE("a mesh that comes, goes or grows around the finger of a real device is faded in, not ramped") {
  const auto small = scene_of(make_icosphere(0.030, 3)), large = scene_of(make_icosphere(0.045, 3));
  for (const double stiffness : {100.0, 800.0, 3500.0}) {
    CAPTURE(stiffness);
    Hold hold(with_stiffness(stiffness));
    hold.press(1.0e-3);
    const auto offer = [&](const std::shared_ptr<const ContactScene>& scene) {
      hold.bench.channels.scenes.offer(std::make_unique<PreparedScene>(scene, Finger{}));
    };
    offer(small);
    check_quiet("the mesh is gone", hold.watch(2000));
    CHECK(hold.bench.run().device.gate_state == GateState::armed);
    offer(large);
    check_quiet("the finger is in a mesh", hold.watch(2000));
    offer(sphere_scene());
    check_quiet("the mesh shrinks", hold.watch(2000));
  }
}
