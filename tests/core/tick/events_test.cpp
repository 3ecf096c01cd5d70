// Events, and what is rendered while a tick has no converged contact.
#include "core/base/tolerances.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

ScenePtr event_sphere() {
  static const ScenePtr scene = scene_of(make_icosphere(0.040, 3));
  return scene;
}
ScenePtr torus() {
  static const ScenePtr scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  return scene;
}

Preset unconvergeable(Preset preset) {
  preset.solver.max_iterations = 1;
  preset.solver.tolerance_m = 0.0;  // no error is below: robust gets down to exactly zero
  return preset;
}

/// Pressed 1 mm deep at the sphere's point in direction n.
Vec3 pressed(const Vec3& n) { return 0.059 * unit(n); }

/// Two plates, one over the other, 60 mm apart: the lower faces up, the upper faces down, as the sides of a slot.
ScenePtr slot() {
  static const ScenePtr scene = [] {
    PolygonMesh mesh = height_field(0.050, 4, [](double, double) { return -0.030; });
    const auto below = static_cast<std::uint32_t>(mesh.positions.size());
    const PolygonMesh upper = height_field(0.050, 4, [](double, double) { return 0.030; });
    mesh.positions.insert(mesh.positions.end(), upper.positions.begin(), upper.positions.end());
    for (std::size_t f = 0; f < upper.face_count(); ++f)
      mesh.add_face({upper.face(f)[0] + below, upper.face(f)[2] + below, upper.face(f)[1] + below});
    return scene_of(mesh);
  }();
  return scene;
}

}  // namespace

TEST_CASE("the first tick is first, the following ones have no event") {
  for (const Method method : kSmoothMethods) {
    Preset preset = sphere_preset(0.020, method);
    Stepper stepper(event_sphere());
    TickState state;
    for (int i = 0; i < 200; ++i) {
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, pressed({1.0, 0.002 * i, 0.001 * i})), state);
      CHECK(out.event == (i == 0 ? TickEvent::first : TickEvent::none));
      CHECK(out.status == TickStatus::face);
    }
  }
}

TEST_CASE("after a leap that tracking can't follow, the contact is seeded anew and marked") {
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Preset preset = sphere_preset(0.020, method);
    preset.solver.max_iterations = 6;
    int marked = 0, right = 0, leaps = 0;
    Random random(60);
    Stepper stepper(event_sphere());
    TickState state;
    Vec3 direction(1, 0, 0);
    stepper.step(preset, at_position(0.0, pressed(direction)), state);
    for (int i = 1; i < 200; ++i) {
      const Vec3 to = random.direction();
      const double angle = angle_deg(direction, to);
      direction = to;
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, pressed(direction)), state);
      if (angle < 90.0) continue;
      ++leaps;
      marked += out.event != TickEvent::none;
      right += out.status == TickStatus::face && glm::length(out.contact - 0.040 * direction) < 1e-4;
    }
    CHECK(leaps > 50);
    CHECK(marked == leaps);
    CHECK(right == leaps);
  }
}

TEST_CASE("robust marks every turn of the normal by over ten degrees in a tick") {
  Random random(61);
  const Preset preset = sphere_preset(0.012, Method::robust);
  for (const ScenePtr& scene : {torus(), event_sphere()}) {
    Stepper stepper(scene);
    TickState state;
    TickOutput last = stepper.step(preset, at_position(0.0, Vec3(0.06, 0.0, 0.0)), state);
    int unmarked = 0, turns = 0;
    for (int i = 1; i < rounds(3000); ++i) {
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, random.in_cube(0.07)), state);
      if (angle_deg(last.normal, out.normal) > 10.1) {
        ++turns;
        unmarked += out.event == TickEvent::none;
      }
      last = out;
    }
    CHECK(turns > 50);
    CHECK(unmarked == 0);
  }
}

TEST_CASE("a deeper place elsewhere takes over once, by the hysteresis, marked switch, and at the right tick") {
  // In the slot the ball touches below and above; it rises from the lower plate to the upper one.
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    for (const double hysteresis : {20e-6, 500e-6}) {
      Preset preset = sphere_preset(0.0305, method);
      preset.solver.switch_hysteresis_m = hysteresis;
      preset.force.contacts = ForceContacts::deepest;
      Stepper stepper(slot());
      TickState state;
      int switches = 0, other = 0;
      double at = 0.0;
      for (int i = 0; i <= 2000; ++i) {
        const double z = -0.001 + 1e-6 * i;
        const TickOutput out = stepper.step(preset, at_position(1e-3 * i, {0.0031, 0.0017, z}), state);
        if (out.event == TickEvent::switched)
          ++switches, at = z;
        else if (i > 0 && out.event != TickEvent::none)
          ++other;
        CHECK(std::abs(out.penetration_m - (0.0005 + (switches ? z : -z))) <= 1e-12);
        CHECK(out.normal.z == approx(switches ? -1.0 : 1.0));
      }
      CHECK(switches == 1);
      CHECK(other == 0);
      // Above the middle the upper plate is deeper by 2 z.
      CHECK(at >= 0.5 * hysteresis - 1e-12);
      CHECK(at <= 0.5 * hysteresis + 1.5e-6);
    }
  }
}

TEST_CASE(
    "without a converged contact the last plane holds for 5 ms, then ramps to zero over 5 ms, at the present pose") {
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Preset good = sphere_preset(0.020, method);
    good.display.travel_m = good.display.finger_arc_m;
    const Preset bad = unconvergeable(good);
    Stepper stepper(event_sphere());
    TickState state;
    const Vec3 n0 = unit(Vec3(1.0, 0.3, -0.5));
    const TickOutput last = stepper.step(good, at_position(1.0, pressed(n0)), state);
    REQUIRE(last.status == TickStatus::face);
    for (int i = 1; i <= 14; ++i) {
      const double since = 1e-3 * i;
      const Vec3 position = pressed(n0) - (1e-5 * i) * n0 + Vec3(0.0, 2e-5 * i, 0.0);
      const TickOutput out = stepper.step(bad, at_position(1.0 + since, position), state);
      CHECK(out.status == TickStatus::unconverged);
      const double share = std::clamp(1.0 - (since - 5e-3) / 5e-3, 0.0, 1.0);
      const double depth = 0.020 - glm::dot(position - last.contact, last.normal);
      CHECK(glm::length(out.force_n - share * 800.0 * depth * last.normal) <= 1e-9);
      CHECK(out.cld_m == approx(share * last.cld_m).epsilon(1e-6).scale(1e-3));
      CHECK(all_finite(out));
    }
    // Converging again ends it.
    const TickOutput again = stepper.step(good, at_position(1.020, pressed(n0)), state);
    CHECK(again.status == TickStatus::face);
    CHECK(glm::length(again.decided_force_n) == approx(800.0 * again.penetration_m));
    CHECK(glm::length(again.force_n) < glm::length(again.decided_force_n));  // comes back faded in
  }
}

TEST_CASE("hold and ramp follow the preset") {
  Preset good = sphere_preset(0.020, Method::robust);
  good.safety = {2e-3, 0.0};
  Stepper stepper(event_sphere());
  TickState state;
  stepper.step(good, at_position(0.0, pressed({1, 0.2, 0.1})), state);
  const Preset bad = unconvergeable(good);
  CHECK(glm::length(stepper.step(bad, at_position(0.0019, pressed({1, 0.2, 0.1001})), state).force_n) > 0.5);
  CHECK(glm::length(stepper.step(bad, at_position(0.0021, pressed({1, 0.2, 0.1})), state).force_n) == 0.0);
}

TEST_CASE("without any converged contact so far force and display are zero") {
  for (const Method method : kSmoothMethods) {
    const Preset bad = unconvergeable(sphere_preset(0.020, method));
    Stepper stepper(event_sphere());
    TickState state;
    for (int i = 0; i < 5; ++i) {
      const TickOutput out = stepper.step(bad, at_position(1e-3 * i, pressed({1.0, 0.3 + 0.01 * i, -0.5})), state);
      CHECK(out.status == TickStatus::unconverged);
      CHECK(glm::length(out.force_n) == 0.0);
      CHECK(out.cld_m == 0.0);
    }
  }
}

TEST_CASE("the paper's iteration without curvature gain does not converge on the torus, and the force ramps out") {
  Preset preset = sphere_preset(0.020, Method::paper);
  preset.solver.gain_curvature_m = 0.0;
  Stepper stepper(torus());
  TickState state;
  int unconverged = 0;
  double force = 1.0;
  for (int i = 0; i < 30; ++i) {
    const double a = 0.002 * i + 0.05;
    const TickOutput out =
        stepper.step(preset, at_position(1e-3 * i, 0.074 * Vec3(std::cos(a), std::sin(a), 0.02)), state);
    unconverged += out.status == TickStatus::unconverged;
    force = glm::length(out.force_n);
  }
  CHECK(unconverged >= 28);
  CHECK(force == 0.0);
}

TEST_CASE("a free finger has a plane and a display position, but no force") {
  for (const Method method : kSmoothMethods) {
    const Preset preset = sphere_preset(0.020, method);
    const TickOutput out =
        solve_once(event_sphere(), preset, {0.061 * unit(Vec3(0.3, 0.1, 1.0)), Quat(1.0, 0.0, 0.0, 0.0)});
    CHECK(out.status == TickStatus::free);
    CHECK(out.penetration_m == approx(-0.001).epsilon(2e-3));
    CHECK(glm::length(out.force_n) == 0.0);
    CHECK(out.cld_m == approx(0.020 * std::atan2(-0.3, 1.0)).epsilon(1e-3));
  }
}

TEST_CASE("damping acts along the normal with the finger's speed, and not on the first tick") {
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.force.damping_n_s_per_m = 5.0;
  Stepper stepper(event_sphere());
  TickState state;
  const TickOutput first = stepper.step(preset, at_position(0.0, {0.059, 0.0, 0.0}), state);
  CHECK(glm::length(first.force_n) == approx(800.0 * first.penetration_m).epsilon(1e-12));
  // In and out at 0.1 m/s, each for 40 ms: 12 lags of the filter.
  TickOutput last = first;
  const auto move = [&](int i, double x) { last = stepper.step(preset, at_position(1e-3 * i, {x, 0.0, 0.0}), state); };
  for (int i = 1; i <= 40; ++i) move(i, 0.0595 - 1e-4 * i);
  CHECK(glm::dot(last.force_n, last.normal) == approx(800.0 * last.penetration_m + 0.5).epsilon(1e-4));
  for (int i = 41; i <= 80; ++i) move(i, 0.0555 + 1e-4 * (i - 40));
  CHECK(last.penetration_m > 1e-4);
  CHECK(glm::dot(last.force_n, last.normal) ==
        approx(std::max(0.0, 800.0 * last.penetration_m - 0.5)).epsilon(1e-4).scale(1e-2));
  for (int i = 81; i <= 90; ++i) move(i, 0.0595 + 5e-4 * (i - 80));
  CHECK(glm::length(last.force_n) == 0.0);  // never pulls
}

namespace {

/// A rough sheet of flat facets: from behind, where they part, some places hold no contact.
ScenePtr facets() {
  ContactMeshOptions flat;
  flat.crease_rad = 0.0;
  static const ScenePtr scene = [&] {
    Random random(1);
    return scene_of(height_field(0.05, 16, [&](double, double) { return random.in(-1e-3, 1e-3); }), flat);
  }();
  return scene;
}

/// A point's way through the sheet and on behind it, 12 mm deep, to and fro.
std::vector<Vec3> way_behind_facets() {
  std::vector<Vec3> way{{0.003, 0.002, 0.002}};
  while (way.back().z > -0.012) way.push_back(way.back() - Vec3(0.0, 0.0, 1e-4));
  Random random(3);
  for (Vec3 to = way.back(); way.size() < 4000; way.push_back(way.back() + 1e-4 * unit(to - way.back())))
    while (glm::distance(way.back(), to) < 1e-4) to = {random.in(-0.03, 0.03), random.in(-0.03, 0.03), -0.012};
  return way;
}

}  // namespace

TEST_CASE("where the surface offers no contact the row says facing, and how far the best place is from being one") {
  const Preset preset = sphere_preset(0.0, Method::robust);
  int facing = 0;
  for (const Vec3& at : way_behind_facets()) {
    const TickOutput out = solve_once(facets(), preset, at);
    if (out.status != TickStatus::facing) continue;
    ++facing;
    CHECK(!is_converged(out.status));
    const Vec3 d = at - out.contact;
    CHECK(std::abs(out.penetration_m - glm::length(d)) < 1e-9);
    CHECK(glm::dot(out.normal, unit(-d)) > 1.0 - 1e-9);  // the plane faces the finger from behind
    CHECK(out.error_m > preset.solver.tolerance_m);      // seen along the surface's own normal
    CHECK(out.error_m < glm::length(d));
    CHECK(out.force_n == Vec3(0.0));  // nothing was touched before
  }
  CHECK(facing > 20);
}

TEST_CASE("a facing tick renders the last contact's plane, and fades as an unconverged one does") {
  Preset preset = sphere_preset(0.0, Method::robust);
  preset.force.stiffness_n_per_m = 40.0;  // half a newton
  Stepper stepper(facets());
  TickState state;
  int facing = 0, last_contact = 0, i = 0;
  Vec3 before(0.0), at(0.0);
  for (const Vec3& next : way_behind_facets()) {
    if (facing > 60) break;
    if (facing == 0) at = next;  // there it stays
    const TickOutput out = stepper.step(preset, at_position(1e-3 * ++i, at), state);
    if (is_converged(out.status)) {
      last_contact = i;
      before = out.force_n;
      CHECK(facing == 0);
      continue;
    }
    CHECK(out.status == TickStatus::facing);
    if (facing++ == 0) CHECK(glm::length(before) > 0.3);
    const Vec3 last = facets()->mesh().origin() + state.last_converged.point;
    const double depth = glm::dot(last - at, state.last_converged.normal);
    const double share = unconverged_share(preset.safety, 1e-3 * (i - last_contact));
    CHECK(glm::distance(out.decided_force_n, share * 40.0 * depth * state.last_converged.normal) < 1e-9);
    CHECK(glm::distance(out.force_n, before) <= 1e-3 * kForceFade + 2.0 * 40.0 * 1.5e-4);
    before = out.force_n;
    if (i > last_contact + 40) CHECK(out.force_n == Vec3(0.0));  // 0.5 N at 20 N/s, begun after 5 ms
  }
  CHECK(facing > 60);
  CHECK(state.last_converged_s == 1e-3 * last_contact);
}

TEST_CASE("names and lists of statuses and events agree") {
  for (std::size_t i = 0; i < kTickStatuses.size(); ++i) CHECK(static_cast<std::size_t>(kTickStatuses[i]) == i);
  for (std::size_t i = 0; i < kTickEvents.size(); ++i) CHECK(static_cast<std::size_t>(kTickEvents[i]) == i);
  CHECK(to_string(TickStatus::facing) == std::string("facing"));
}

TEST_CASE("a small finger round a cube's edge goes on without an event, however fast it turns") {
  const ScenePtr cube = scene_of(*generate_mesh("cube"));
  const double half = 0.5 * cube->mesh().bounds().size().z;
  const Preset preset = sphere_preset(0.001, Method::robust);
  for (const double speed : {2e-5, 1e-4, 3e-4}) {  // metres a tick
    CAPTURE(speed);
    Stepper stepper(cube);
    TickState state;
    int marked = 0, turned_fast = 0;
    Vec3 last(0.0);
    const int ticks = static_cast<int>(0.004 / speed);
    for (int i = 0; i < ticks; ++i) {
      const double s = -0.002 + speed * i;  // up one side, round the edge 0.5 mm away, over the next side
      const double arc = 0.0005 * 1.5707963267948966, turn = std::clamp(s + 0.5 * arc, 0.0, arc) / 0.0005;
      const Vec3 out_of(std::cos(turn), 0.0, std::sin(turn));
      const double along = s + 0.5 * arc - std::clamp(s + 0.5 * arc, 0.0, arc);
      const Vec3 at = Vec3(half, 0.003, half) + 0.0005 * out_of + along * Vec3(-out_of.z, 0.0, out_of.x);
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, at), state);
      marked += i > 0 && out.event != TickEvent::none;
      turned_fast += i > 0 && angle_deg(out.normal, last) > 10.0;
      last = out.normal;
    }
    CHECK(marked == 0);
    if (speed > 0.9e-4) CHECK(turned_fast > 1);
  }
}

namespace {

/// Turns of the normal by over ten degrees in a tick: how many are marked, how many are not, and how many of the marked
/// ones are no leaps, since the same way in many small steps has no event.
struct Turns {
  int marked = 0, unmarked = 0, no_leaps = 0;
};

/// Straight ways at 0.15 m/s over waves whose hollows are about as narrow as the finger.
Turns turns_over_waves(const ScenePtr& scene, int ways) {
  const Preset preset = sphere_preset(0.005, Method::robust);
  Stepper in_small_steps(scene);
  Random random(5);
  Turns turns;
  for (int way = 0; way < ways; ++way) {
    Stepper stepper(scene);
    TickState state;
    TickOutput last;
    const double towards = random.in(0.0, 6.28);
    Vec3 at(random.in(-0.005, 0.005), random.in(-0.005, 0.005), 0.0045);
    for (int i = 0; i < 60; ++i) {
      TickState before = state;
      const Vec3 from = at;
      at += 0.15e-3 * Vec3(std::cos(towards), std::sin(towards), 0.0);
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, at), state);
      const bool turned =
          i > 0 && is_converged(out.status) && is_converged(last.status) && angle_deg(out.normal, last.normal) > 10.01;
      last = out;
      if (!turned) continue;
      ++(out.event == TickEvent::none ? turns.unmarked : turns.marked);
      int events = 0;
      for (int k = 1; k <= 100; ++k) {
        const TickInput input = at_position(1e-3 * (i - 1 + 0.01 * k), from + 0.01 * k * (at - from));
        events += in_small_steps.step(preset, input, before).event != TickEvent::none;
      }
      turns.no_leaps += out.event != TickEvent::none && events == 0;
    }
  }
  return turns;
}

}  // namespace

TEST_CASE("a leap over a fold is marked, though the finger's motion may explain as much turning") {
  const auto waves = [](double x, double y) {
    const double k = 2.0 * 3.14159265 / 5e-3;
    return 0.15e-3 * (std::sin(k * x) * std::sin(0.7 * k * y + 1.0) + 0.5 * std::sin(1.7 * k * (x + y)));
  };
  const Turns turns = turns_over_waves(scene_of(height_field(0.020, 24, waves)), rounds(150));
  MESSAGE(turns.marked << " marked, " << turns.no_leaps << " of them no leaps, " << turns.unmarked << " unmarked");
  CHECK(turns.marked >= rounds(10));
  CHECK(turns.no_leaps == 0);
  CHECK(turns.unmarked == 0);
}
