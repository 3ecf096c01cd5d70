// Nothing pushes that the finger did not enter from outside: sheets from behind, the far side of plates and fins. And a
// finger that was put elsewhere is in what is there.
#include "tests/core/fingers.h"
#include "tests/core/random_bodies.h"

using namespace tangent;
using namespace tangent::test;

namespace {

/// From above round a rim of a sheet of 100 mm and to and fro below it, the centre `below_m` under it, at 0.1 m/s.
std::vector<Vec3> way_behind(double below_m, Random& random) {
  const double beyond = 0.05 + 0.003 + below_m;
  const Vec3 corners[] = {{0.0, 0.0, below_m}, {beyond, 0.0, below_m}, {beyond, 0.0, -below_m}};
  std::vector<Vec3> way{corners[0]};
  const auto go_to = [&](const Vec3& to) {
    const Vec3 from = way.back();
    const int ticks = std::max(1, static_cast<int>(glm::distance(from, to) / 1e-4));
    for (int i = 1; i <= ticks; ++i) way.push_back(from + i / static_cast<double>(ticks) * (to - from));
  };
  for (const Vec3& corner : corners) go_to(corner);
  for (int i = 0; i < 6; ++i) go_to({random.in(-0.04, 0.04), random.in(-0.04, 0.04), -below_m});
  return way;
}

PolygonMesh box(const Vec3& half) {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
  for (const auto& f : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    mesh.add_face({f[0], f[1], f[2]});
    mesh.add_face({f[0], f[2], f[3]});
  }
  return mesh;
}

}  // namespace

TEST_CASE("behind a rough open sheet nothing pushes, also where a tick found no contact before") {
  Random random(8);
  int behind = 0, facing = 0, pushed = 0;
  for (int i = 0; i < rounds(20); ++i) {
    const ScenePtr scene = scene_of(height_field(0.05, 16, [&](double, double) { return random.in(-1e-3, 1e-3); }));
    for (const FingerShape shape : {FingerShape::point, FingerShape::sphere, FingerShape::capsule}) {
      Preset preset = sphere_preset(shape == FingerShape::point ? 0.0 : 0.008, Method::robust);
      preset.finger.shape = shape;
      preset.finger.half_length_m = 0.010;
      preset.force.contacts = i % 2 ? ForceContacts::all : ForceContacts::deepest;
      Stepper stepper(scene);
      TickState state;
      const double below = preset.finger.reach_m() + random.in(0.004, 0.02);
      double t = 0.0;
      for (const Vec3& at : way_behind(below, random)) {
        const TickOutput out = stepper.step(preset, at_position(t += 1e-3, at), state);
        if (!(at.z <= -below)) continue;
        ++behind;
        facing += out.status == TickStatus::facing;
        pushed += out.decided_force_n != Vec3(0.0);
      }
    }
  }
  CHECK(behind > rounds(20) * 3 * 1000);
  CHECK(facing > rounds(20) / 2);
  CHECK(pushed == 0);
}

TEST_CASE("through a fin and a plate the finger is pushed back to where it came in, and past them not at all") {
  for (const double thick : {3e-4, 1e-3}) {
    const ScenePtr scene = scene_of(box({0.5 * thick, 0.03, 0.03}));
    for (const double radius : {0.0, 0.005, 0.020})
      for (const ForceContacts contacts : {ForceContacts::all, ForceContacts::deepest}) {
        Preset preset = sphere_preset(radius, Method::robust);
        preset.force.contacts = contacts;
        Stepper stepper(scene);
        TickState state;
        int pushed_back = 0, pushed_on = 0, past = 0, pushed_past = 0;
        const double end = radius + 0.5 * thick + 2e-3;
        for (double x = -end, t = 0.0; x < end; x += 2e-5) {
          const TickOutput out = stepper.step(preset, at_position(t += 1e-3, {x, 0.001, 0.002}), state);
          const bool left = x > radius + 0.5 * thick + 1e-4;
          pushed_back += out.decided_force_n.x < 0.0;
          pushed_on += out.decided_force_n.x > 0.0;
          past += left;
          pushed_past += left && out.decided_force_n != Vec3(0.0);
        }
        CAPTURE(thick);
        CAPTURE(radius);
        CAPTURE(static_cast<int>(contacts));
        CHECK(pushed_back > 0.9 * (thick + 2.0 * radius) / 2e-5);
        CHECK(pushed_on == 0);
        CHECK(past > 50);
        CHECK(pushed_past == 0);
      }
  }
}

TEST_CASE("fingers that are not round are let go, too, when they have come through a plate") {
  Random random(5);
  int past = 0, pushed_past = 0, pushed_back = 0;
  for (const double thick : {3e-4, 1e-3}) {
    const ScenePtr scene = scene_of(box({0.5 * thick, 0.05, 0.05}));
    for (int i = 0; i < rounds(40); ++i) {
      Preset preset = sphere_preset(0.0, Method::robust);
      preset.finger = finger_of(i % 2 ? FingerShape::ellipsoid : FingerShape::capsule);
      preset.force.contacts = i % 4 < 2 ? ForceContacts::all : ForceContacts::deepest;
      FingerPose pose{Vec3(0.0), random.orientation()};
      const double half = std::abs(support_point(preset.finger, pose, Vec3(1.0, 0.0, 0.0)).x);
      Stepper stepper(scene);
      TickState state;
      double t = 0.0;
      for (double x = -half - 1e-3; x < half + 4e-3; x += 5e-5) {
        pose.position = Vec3(x, 0.001, 0.002);
        const TickOutput out = stepper.step(preset, {t += 1e-3, pose}, state);
        const bool left = x > half + 0.5 * thick + 1e-4;
        pushed_back += out.decided_force_n.x < 0.0;
        past += left;
        pushed_past += left && out.decided_force_n != Vec3(0.0);
      }
    }
  }
  MESSAGE(pushed_past << " of " << past << " ticks past the plate push");
  CHECK(pushed_back > past);
  CHECK(pushed_past <= past / 100);
}

TEST_CASE("through a plate while no tick looks the finger is let go when one does again") {
  constexpr double thick = 1e-3;
  const ScenePtr scene = scene_of(box({0.5 * thick, 0.03, 0.03}));
  for (const double radius : {0.0, 5e-4, 0.005, 0.020})
    for (const ForceContacts contacts : {ForceContacts::all, ForceContacts::deepest}) {
      Preset preset = sphere_preset(radius, Method::robust);
      preset.force.contacts = contacts;
      Stepper stepper(scene);
      TickState state;
      int past = 0, pushed_past = 0;
      for (double x = -radius - 1e-3, t = 0.0; x < radius + 6e-3; x += 5e-5) {
        TickInput input = at_position(t += 1e-3, {x, 0.001, 0.002});
        input.unready = x > radius + 3e-4 && x < radius + 1.5e-3;
        const TickOutput out = stepper.step(preset, input, state);
        const bool left = x >= radius + 1.5e-3;
        past += left;
        pushed_past += left && out.decided_force_n != Vec3(0.0);
      }
      CAPTURE(radius);
      CAPTURE(static_cast<int>(contacts));
      CHECK(past > 50);
      CHECK(pushed_past == 0);
    }
}

TEST_CASE("a point that comes in under a sheet's rim from free air is not pushed from behind") {
  const ScenePtr scene = scene_of(height_field(0.020, 8, [](double, double) { return 0.0; }));
  for (const double below : {1e-3, 1.5e-3, 1.9e-3})
    for (const double speed : {0.01, 0.1}) {
      Stepper stepper(scene);
      TickState state;
      int under = 0, pushed = 0;
      for (double y = 0.02005, t = 0.0; y > 0.016; y -= 1e-3 * speed) {
        const TickOutput out =
            stepper.step(sphere_preset(0.0, Method::robust), at_position(t += 1e-3, {0.003, y, -below}), state);
        ++under;
        pushed += out.decided_force_n != Vec3(0.0);
      }
      CAPTURE(below);
      CAPTURE(speed);
      CHECK(under >= 40);
      CHECK(pushed == 0);
    }
}

TEST_CASE("a finger that was put elsewhere is at the deepest place there, as a first tick would be") {
  Random random(9);
  int leaps = 0, shallower = 0, touching = 0;
  for (int body = 0; body < rounds(20); ++body) {
    PolygonMesh mesh = body % 2 ? random_blob(random) : make_icosphere(0.036, 0);
    const ScenePtr scene = scene_of(mesh);
    const Preset preset = sphere_preset(body % 3 ? 0.020 : 0.005, Method::robust);
    Stepper stepper(scene);
    for (int i = 0; i < 100; ++i) {
      TickState state;
      const Vec3 origin = scene->mesh().origin(), away = random.direction();
      stepper.step(preset, at_position(0.0, origin + 0.5 * away), state);
      const NearestHit hit =
          scene->nearest().nearest(0.1 * random.direction(), std::numeric_limits<double>::infinity());
      const Vec3 at = origin + hit.point + (preset.finger.radius_m - random.in(0.0, 0.003)) * unit(hit.point);
      const TickOutput out = stepper.step(preset, at_position(1e-3, at), state);
      const TickOutput alone = solve_once(scene, preset, at);
      ++leaps;
      touching += alone.penetration_m > 0.0;
      shallower += out.penetration_m < alone.penetration_m - 1.1 * preset.solver.switch_hysteresis_m;
    }
  }
  CHECK(leaps == 100 * rounds(20));
  CHECK(touching > leaps / 2);
  CHECK(shallower == 0);
}
