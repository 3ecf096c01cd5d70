// Force and display never jump: changes that the finger's motion does not explain are faded in, at a stated rate.
#include "core/shading/blend.h"
#include "core/base/tolerances.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kTick = 1e-3;

/// Most by which the force may change in a tick.
double force_bound(const Preset& preset, const Vec3& moved, double dt_s) {
  return kForceFade * dt_s + 2.0 * preset.force.stiffness_n_per_m * glm::length(moved);
}
double display_bound(const Preset& preset, const Vec3& moved, double dt_s) {
  const DisplaySettings& d = preset.display;
  return kDisplayFade * d.travel_m * dt_s + 2.0 * d.travel_m / d.finger_arc_m * glm::length(moved);
}

struct Roughness {
  int force_leaps = 0, display_leaps = 0;  ///< ticks over the bound
  int decided_force_leaps = 0, decided_display_leaps = 0;
};

/// Steps through poses; `change` may set another preset before a tick.
Roughness run(const ScenePtr& scene, Preset preset, int ticks, const std::function<TickInput(int)>& pose,
              const std::function<void(int, Preset&)>& change = {}) {
  Stepper stepper(scene);
  TickState state;
  Roughness r;
  TickOutput last;
  TickInput before;
  for (int i = 0; i < ticks; ++i) {
    if (change) change(i, preset);
    const TickInput input = pose(i);
    const TickOutput out = stepper.step(preset, input, state);
    if (i > 0) {
      const Vec3 moved = input.finger.position - before.finger.position;
      const double most = (1.0 + 1e-9) * force_bound(preset, moved, input.t_s - before.t_s) + 1e-12;
      const double far = (1.0 + 1e-9) * display_bound(preset, moved, input.t_s - before.t_s) + 1e-15;
      r.force_leaps += glm::distance(out.force_n, last.force_n) > most;
      r.display_leaps += std::abs(out.cld_m - last.cld_m) > far;
      r.decided_force_leaps += glm::distance(out.decided_force_n, last.decided_force_n) > most;
      r.decided_display_leaps += std::abs(out.decided_cld_m - last.decided_cld_m) > far;
    }
    last = out;
    before = input;
  }
  return r;
}

/// Two walls at a right angle, and a finger pressed 1 mm into both that trembles by 50 um.
ScenePtr corner() {
  ContactMeshOptions creased;
  creased.crease_rad = 0.5;
  static const ScenePtr scene =
      scene_of(height_field(0.040, 24, [](double x, double) { return std::abs(x); }), creased);
  return scene;
}
TickInput trembling(int i) {
  static Random random{9};
  const double r = 0.005, tip = (r - 1e-3) * std::sqrt(2.0);
  return at_position(kTick * i, {5e-5 * random.in(-1.0, 1.0), 0.0, tip + 5e-5 * random.in(-1.0, 1.0)});
}

}  // namespace

TEST_CASE("in a corner the decided force flips from wall to wall, the rendered one changes at the stated rate") {
  Preset deepest = sphere_preset(0.005, Method::robust);
  deepest.force.contacts = ForceContacts::deepest;
  Roughness r = run(corner(), deepest, 3000, trembling);
  CHECK(r.decided_force_leaps > 20);
  CHECK(r.decided_display_leaps > 20);
  CHECK(r.force_leaps == 0);
  CHECK(r.display_leaps == 0);
  Preset off = deepest;
  off.force.blend = ForceBlend::off;
  r = run(corner(), off, 3000, trembling);
  CHECK(r.force_leaps == r.decided_force_leaps);
  CHECK(r.force_leaps > 20);
}

TEST_CASE("a change of preset in contact is faded in, whatever the method") {
  const ScenePtr ball = scene_of(make_icosphere(0.040, 3));
  const auto slide = [](int i) { return at_position(kTick * i, 0.0573 * unit(Vec3(1.0, 1e-4 * i, 0.0))); };
  for (const Method method : {Method::robust, Method::facet, Method::force_shading, Method::two_pass}) {
    CAPTURE(to_string(method));
    const Roughness r = run(ball, sphere_preset(0.020, method), 400, slide, [](int i, Preset& p) {
      if (i == 200) p.force.stiffness_n_per_m = 3500.0;
    });
    CHECK(r.decided_force_leaps >= 1);
    CHECK(r.force_leaps == 0);
  }
  const Roughness r = run(ball, sphere_preset(0.020, Method::robust), 400, slide, [](int i, Preset& p) {
    if (i == 200) p.solver.method = Method::facet;
  });
  CHECK(r.force_leaps == 0);
}

TEST_CASE("facet keeps its edges: nothing is faded in while the preset stays") {
  const ScenePtr cube = scene_of(*generate_mesh("cube"));
  const auto round = [](int i) {
    const double a = 1e-3 * i;
    return at_position(kTick * i, {0.0300 * std::cos(a), 0.0300 * std::sin(a), 0.0});
  };
  Preset preset = sphere_preset(0.020, Method::facet);
  preset.force.limit_n = 100.0;
  Stepper stepper(cube);
  TickState state;
  for (int i = 0; i < 1500; ++i) {
    const TickOutput out = stepper.step(preset, round(i), state);
    CHECK(out.force_n == out.decided_force_n);
    CHECK(out.cld_m == out.decided_cld_m);
  }
}

TEST_CASE("a fade ends: at rest the decided force is reached, after as long as the rate says") {
  Preset preset;
  RenderedState state;
  blend(preset, {}, {{0.0, 0.0, 1.0}, 0.0, false}, false, state);
  const Rendered decided{{2.0, 0.0, 0.0}, 0.004, false};
  int ticks = 0;
  Rendered out;
  for (; ticks < 1000 && out.force_n != decided.force_n; ++ticks)
    out = blend(preset, {Vec3(0.0), kTick}, decided, false, state);
  const double way = std::sqrt(1.0 + 4.0);  // from (0, 0, 1) to (2, 0, 0)
  CHECK(ticks == static_cast<int>(std::ceil(way / (kForceFade * kTick))));
  CHECK(out.cld_m == decided.cld_m);
}

TEST_CASE("leaving the old plane ends its force, as fast as the finger leaves") {
  Preset preset;
  RenderedState state;
  blend(preset, {}, {{0.0, 0.0, 0.8}, 0.0, false}, false, state);  // 1 mm deep
  Rendered out;
  for (int i = 0; i < 10; ++i) out = blend(preset, {Vec3(0.0, 0.0, 1.1e-4), kTick}, {}, false, state);
  CHECK(out.force_n == Vec3(0.0));
}

TEST_CASE("the display waits after a switch, and holds where the contact is off the pad") {
  Preset preset;
  RenderedState state;
  blend(preset, {}, {Vec3(0.0), 0.002, false}, false, state);
  const Rendered there{Vec3(0.0), -0.006, false}, behind{.cld_m = 0.008, .off_pad = true};
  CHECK(blend(preset, {Vec3(0.0), kTick}, there, true, state).cld_m == 0.002);
  for (int i = 0; i < 49; ++i) CHECK(blend(preset, {Vec3(0.0), kTick}, there, false, state).cld_m == 0.002);
  double last = 0.002;
  for (int i = 0; i < 100; ++i) last = blend(preset, {Vec3(0.0), kTick}, there, false, state).cld_m;
  CHECK(last == -0.006);
  CHECK(blend(preset, {Vec3(0.0), kTick}, behind, false, state).cld_m == -0.006);
}

TEST_CASE("damping's velocity is bounded however near two stamps are") {
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.force.damping_n_s_per_m = 5.0;
  const ScenePtr ball = scene_of(make_icosphere(0.040, 3));
  Stepper stepper(ball);
  TickState state;
  Random random{4};
  double t = 0.0;
  Vec3 last(0.0);
  for (int i = 0; i < 2000; ++i) {
    // An encoder's steps of 0.03 mm at rest, stamps 0.1 us to 1 ms apart.
    const double dt = i % 2 ? 1e-7 : 1e-3;
    t += dt;
    const TickOutput out = stepper.step(preset, at_position(t, {0.059 + 3e-5 * random.below(2), 0.0, 0.0}), state);
    if (i > 0) CHECK(glm::distance(out.force_n, last) <= 0.02 + 2.0 * 800.0 * 3e-5 + 1e-9);
    last = out.force_n;
  }
  CHECK(glm::length(last) > 0.5);
  CHECK(glm::length(last) < 1.2);
}

TEST_CASE("after a change of preset a finger that is pushed out explains no more force, however stiff the surface is") {
  // A free mass in the fade of 100 to 3500 N/m: nothing holds it but the law itself.
  for (const ForceBlend on : {ForceBlend::events, ForceBlend::off}) {
    Preset preset;
    preset.force.stiffness_n_per_m = 3500.0;
    preset.force.limit_n = 8.5;
    preset.force.blend = on;
    RenderedState state;
    Preset soft = preset;
    soft.force.stiffness_n_per_m = 100.0;
    blend(soft, {}, {{0.0, 0.0, 0.27}, 0.0, false}, false, state);
    begin_change(state);
    double depth = 2.7e-3, speed = 0.0, fastest = 0.0, force = 0.27;
    int ticks = 0;
    for (; ticks < 5000 && depth > 0.0; ++ticks) {
      const double moved = speed * kTick;
      depth -= moved;
      const Rendered decided{{0.0, 0.0, std::clamp(3500.0 * depth, 0.0, 8.5)}, 0.0, false};
      force = blend(preset, {Vec3(0.0, 0.0, moved), kTick}, decided, false, state).force_n.z;
      speed += kTick / 0.175 * (force - 0.27 - 12.0 * speed);  // a hand that pushes with what it pushed, and damps
      fastest = std::max(fastest, speed);
    }
    CHECK(fastest < 0.05);
    CHECK(state.changes == 0);
  }
}

TEST_CASE("a change of preset ends, also behind a finger that slides quickly over a tight curve") {
  Preset preset;
  RenderedState state;
  blend(preset, {}, {{0.0, 0.0, 4.0}, 0.0, false}, false, state);
  begin_change(state);
  int ticks = 0;
  for (; ticks < 20'000 && state.changes; ++ticks) {
    const double turn = 20.0 * kTick * ticks;  // 0.1 m/s around 5 mm
    const Vec3 normal(std::sin(turn), 0.0, std::cos(turn)), along(std::cos(turn), 0.0, -std::sin(turn));
    blend(preset, {1e-4 * along, kTick}, {4.0 * normal, 0.001, false}, false, state);
  }
  CHECK(ticks < 5000);
}

TEST_CASE("without a change nothing is faded that was not before") {
  Preset off;
  off.force.blend = ForceBlend::off;
  RenderedState state;
  blend(off, {}, {{0.0, 0.0, 1.0}, 0.0, false}, false, state);
  CHECK(blend(off, {Vec3(0.0), kTick}, {{3.0, 0.0, 0.0}, 0.002, false}, false, state).force_n == Vec3(3.0, 0.0, 0.0));
  begin_change(state);
  const Rendered first = blend(off, {Vec3(0.0), kTick}, {{0.0, 0.0, 3.0}, 0.002, false}, false, state);
  CHECK(glm::distance(first.force_n, Vec3(3.0, 0.0, 0.0)) == approx(kForceFade * kTick).epsilon(1e-3));
}
