// Force from every place that the finger touches.
#include "core/base/tolerances.h"
#include "core/lab/measure/closed_work.h"
#include "tests/core/recorded_scenes.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Two walls, or three, that meet at right angles: wall k faces along axis k, in the plane where that is zero, and runs
/// from zero to 40 mm along the other two; where there are two, from -20 to 20 mm along z.
ScenePtr walls(int count) {
  constexpr int kCells = 8;
  PolygonMesh mesh;
  mesh.name = "walls";
  for (int k = 0; k < count; ++k) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (kCells + 1) + i); };
    for (int j = 0; j <= kCells; ++j)
      for (int i = 0; i <= kCells; ++i) {
        Vec3 p(0.0);
        p[(k + 1) % 3] = 0.040 * i / kCells;
        p[(k + 2) % 3] = 0.040 * j / kCells;
        if (count == 2) p.z -= 0.020;
        mesh.positions.push_back(p);
      }
    for (int j = 0; j < kCells; ++j)
      for (int i = 0; i < kCells; ++i) {
        mesh.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.add_face({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  return scene_of(mesh);
}

Preset all_of(double radius_m) {
  Preset preset = sphere_preset(radius_m, Method::robust);
  preset.force.contacts = ForceContacts::all;
  return preset;
}

bool same_touch(const TickOutput& a, const TickOutput& b) {
  BitHash x, y;
  x.add(a), y.add(b);
  return x.value() == y.value();
}

/// Over and round a mesh, in and out of contact.
TickInput round(int i) {
  const double s = 2e-3 * i;
  return at_position(
      1e-3 * i, (0.0435 + 0.002 * std::sin(0.31 * s)) * unit(Vec3(std::cos(s), std::sin(s), 0.6 * std::sin(0.37 * s))));
}

}  // namespace

TEST_CASE("in a corner of two walls or three the force leads out of all of them, wherever the finger goes there") {
  for (const int count : {2, 3}) {
    CAPTURE(count);
    Random random{21};
    Stepper stepper(walls(count));
    TickState state;
    const Preset preset = all_of(0.005);
    Vec3 finger(0.0043, 0.0041, 0.0047);
    int several = 0, wrong = 0, flips = 0;
    for (int i = 0; i < 3000; ++i) {
      finger = glm::clamp(finger + 2e-5 * random.direction(), Vec3(0.0032), Vec3(0.0052));
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, finger), state);
      Vec3 depth = glm::max(Vec3(0.005) - finger, Vec3(0.0));
      if (count == 2) depth.z = 0.0;
      several += (depth.x > 0.0) + (depth.y > 0.0) + (depth.z > 0.0) > 1;
      wrong += i > 0 && glm::distance(out.decided_force_n, 800.0 * depth) > 1e-5;
      flips += i > 0 && out.event != TickEvent::none;
    }
    CHECK(several > 1000);
    CHECK(wrong == 0);
    CHECK(flips < 30);  // of the display: by more than a tremor
  }
}

TEST_CASE(
    "force.contacts = all does in a tremor what the deepest place can't: no change that the motion doesn't explain") {
  for (const ForceContacts contacts : {ForceContacts::deepest, ForceContacts::all}) {
    CAPTURE(static_cast<int>(contacts));
    Random random{22};
    Stepper stepper(walls(2));
    TickState state;
    Preset preset = all_of(0.005);
    preset.force.contacts = contacts;
    int leaps = 0, flips = 0;
    TickOutput last;
    Vec3 before(0.0);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 finger = Vec3(0.004, 0.004, 0.0) + 5e-5 * random.in_cube(1.0);
      const TickOutput out = stepper.step(preset, at_position(1e-3 * i, finger), state);
      if (i > 1) {
        leaps +=
            glm::distance(out.decided_force_n, last.decided_force_n) > 800.0 * glm::distance(finger, before) + 1e-5;
        flips += out.event != TickEvent::none;
      }
      last = out;
      before = finger;
    }
    if (contacts == ForceContacts::all) {
      CHECK(leaps == 0);
      CHECK(flips == 0);
    } else {
      CHECK(leaps > 100);
      CHECK(flips > 100);
    }
  }
}

TEST_CASE("a second wall that is found is followed from then on, and nothing is looked for again for that") {
  const ScenePtr scene = walls(2);
  const Preset preset = all_of(0.005);
  Stepper stepper(scene);
  TickState state;
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t before = state.touched.count;
    stepper.step(preset, at_position(1e-3 * i, {0.0060 - 1e-5 * i, 0.0049, 0.0}), state);
    if (state.touched.count <= before) continue;
    ++found;
    CHECK(state.clearance.margin_m > 0.0);
  }
  CHECK(found == 1);
}

TEST_CASE("a wall that the finger has left pushes again in the tick in which it is touched again") {
  Stepper stepper(walls(2));
  const Preset preset = all_of(0.005);
  const double tremor = kLeftTouch * preset.solver.switch_hysteresis_m;
  TickState state;
  int several = 0, left = 0, late = 0;
  for (int i = 0; i < 1200; ++i) {
    const double depth = 2.5e-4 * std::sin(0.05 * i);  // less than in the other one
    const std::uint32_t before = state.touched.count;
    stepper.step(preset, at_position(1e-3 * i, {0.0047, 0.0050 - depth, 5e-3 * std::sin(0.021 * i)}), state);
    left += state.touched.count < before;
    several += depth > 1e-6 && state.touched.count == 1;
    late += (depth > 1e-6 && state.touched.count != 1) || (depth < -tremor - 1e-6 && state.touched.count > 0);
  }
  CHECK(left > 5);
  CHECK(several > 500);
  CHECK(late == 0);
}

TEST_CASE("round the corner and back the force of all places does no work, that of the deepest does where it flips") {
  const FingerPose middle{Vec3(0.0041, 0.0042, 0.0), Quat(1, 0, 0, 0)};
  const auto loop = circle_of_poses(middle, Vec3(0, 0, 1), 5e-4, 4096);
  const auto work = [&](ForceContacts contacts, ForceBlend blend) {
    Preset preset = all_of(0.005);
    preset.force.contacts = contacts;
    preset.force.blend = blend;
    Stepper stepper(walls(2));
    return work_around(stepper, preset, loop).relative();
  };
  const double all = work(ForceContacts::all, ForceBlend::events);
  const double deepest = work(ForceContacts::deepest, ForceBlend::off);
  const double faded = work(ForceContacts::deepest, ForceBlend::events);
  MESSAGE("work of the peak energy, once round: all places " << all << ", deepest " << deepest << ", faded " << faded);
  CHECK(all < 1e-6);
  CHECK(deepest > 1e-3);
}

TEST_CASE("exactly in the middle of a slot that is too narrow for the finger neither wall pushes") {
  PolygonMesh mesh;
  mesh.name = "slot";
  for (const double x : {-0.015, 0.015}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec2& at : {Vec2(-0.05, -0.05), {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}})
      mesh.positions.emplace_back(x, x < 0.0 ? at.x : -at.x, at.y);
    mesh.add_face({first, first + 1, first + 2});
    mesh.add_face({first, first + 2, first + 3});
  }
  Stepper stepper(scene_of(mesh));
  const Preset preset = sphere_preset(0.0155, Method::robust);
  TickState state;
  for (int i = -20; i <= 20; ++i) {
    const double x = 1e-6 * i;
    const TickOutput out = stepper.step(preset, at_position(1e-3 * i, {x, 0.001, 0.002}), state);
    CAPTURE(i);
    CHECK(glm::distance(out.decided_force_n, Vec3(-800.0 * x, 0.0, 0.0)) < 1e-6);
  }
}

TEST_CASE("where one place is touched, all of them are that one, bit for bit") {
  for (const ScenePtr& scene : {scene_of(make_icosphere(0.040, 3)), scene_of(*generate_mesh("sphere"))}) {
    Stepper one(scene), every(scene);
    TickState a, b;
    Preset deepest = all_of(0.005);
    deepest.force.contacts = ForceContacts::deepest;
    int differ = 0, touching = 0;
    for (int i = 0; i < 4000; ++i) {
      const TickOutput x = one.step(deepest, round(i), a), y = every.step(all_of(0.005), round(i), b);
      touching += x.status != TickStatus::free;
      differ += x.force_n != y.force_n || x.contact != y.contact || y.way_out_m != Vec3(0.0);
    }
    CHECK(differ == 0);
    CHECK(touching > 500);
  }
}

TEST_CASE("of a wall's two sides, and of a sharp edge seen from inside, one pushes") {
  const ScenePtr cube = scene_of(*generate_mesh("cube"));
  const Preset preset = all_of(0.0);
  Stepper stepper(cube);
  TickState state;
  const double half = 0.5 * cube->mesh().bounds().size().x;
  Random random{23};
  for (int i = 0; i < 500; ++i) {
    const Vec3 finger = Vec3(half - 0.001, half - 0.001, 0.0) + 3e-5 * random.in_cube(1.0);
    const TickOutput out = stepper.step(preset, at_position(1e-3 * i, finger), state);
    CHECK(out.way_out_m == Vec3(0.0));
    CHECK(glm::length(out.decided_force_n) < 800.0 * 1.04e-3);
  }
}

TEST_CASE("with all places, too, a cold stepper and a copied state give the same bits") {
  const ScenePtr scene = scene_of(
      height_field(0.020, 40, [](double x, double y) { return 0.0015 * std::sin(900.0 * x) * std::sin(700.0 * y); }));
  const Preset preset = all_of(0.010);
  Stepper stepper(scene);
  TickState state;
  int differ = 0, several = 0;
  for (int i = 0; i < rounds(4000); ++i) {
    const double s = 3e-3 * i;
    const TickInput input =
        at_position(1e-3 * i, {0.010 * std::sin(s), 0.010 * std::sin(0.83 * s), 0.0105 + 5e-4 * std::sin(3.1 * s)});
    TickState copy = state;
    const TickOutput out = stepper.step(preset, input, state);
    Stepper cold(scene);
    const TickOutput again = cold.step(preset, input, copy);
    differ += !same_touch(out, again) || out.way_out_m != again.way_out_m || copy.touched.count != state.touched.count;
    several += state.touched.count > 0;
  }
  CHECK(differ == 0);
  CHECK(several > rounds(4000) / 10);
}

namespace {

/// Ticks in which the force that is decided changes by more than the motion explains and a fade lets through.
struct Leaps {
  int marked = 0, unmarked = 0;
};

Leaps leaps_over(const ScenePtr& scene, const Preset& preset, const std::vector<Vec3>& way) {
  Leaps leaps;
  Stepper stepper(scene);
  TickState state;
  TickOutput last;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const TickOutput out = stepper.step(preset, at_position(1e-3 * static_cast<double>(i), way[i]), state);
    const bool solved = i > 0 && is_converged(out.status) && is_converged(last.status);
    const double explained = i > 0 ? 2.0 * 800.0 * glm::distance(way[i], way[i - 1]) : 0.0;
    // The force that the leap is told by is the last planes' at the present pose: that much nearer by the motion.
    if (solved && glm::distance(out.decided_force_n, last.decided_force_n) > 1.5 * explained + 0.021)
      ++(out.event == TickEvent::none ? leaps.unmarked : leaps.marked);
    last = out;
  }
  return leaps;
}

}  // namespace

TEST_CASE("where a place that pushes with others comes up deep or ends at once the leap is marked") {
  const RecordedScene stairs = recorded_scene("staircase");
  std::vector<Vec3> spiral;
  for (const TickInput& input : stairs.poses) spiral.push_back(input.finger.position);
  Leaps leaps = leaps_over(stairs.scene, all_of(0.020), spiral);
  ContactMeshOptions smooth;
  smooth.crease_rad = 180.0 * kDegree;
  const ScenePtr crate =
      scene_of(height_field(0.020, 20,
                            [](double x, double y) { return 0.003 * std::sin(600.0 * x) * std::sin(540.0 * y + 1.0); }),
               smooth);
  for (int w = 0; w < 40; ++w) {
    Random random{static_cast<std::uint64_t>(30 + w)};
    const Vec3 along = random.direction();
    Vec3 at(random.in(-0.01, 0.01), random.in(-0.01, 0.01), random.in(0.003, 0.006));
    std::vector<Vec3> way(80);
    for (Vec3& p : way) p = at += 5e-5 * along;
    const Leaps more = leaps_over(crate, all_of(0.005), way);
    leaps.marked += more.marked, leaps.unmarked += more.unmarked;
  }
  MESSAGE(leaps.marked << " leaps are marked, " << leaps.unmarked << " are not");
  CHECK(leaps.marked >= 10);
  CHECK(leaps.unmarked == 0);
}

TEST_CASE("past a thin rim, where the edge that pushed ends, the leap is marked") {
  PolygonMesh mesh;  // a wedge: its underside faces down, its top slopes by a tenth, they meet at x = 0
  const double a = 0.04, b = 0.03;
  mesh.positions = {{0, -b, 0}, {0, b, 0}, {-a, -b, 0}, {-a, b, 0}, {-a, -b, 0.1 * a}, {-a, b, 0.1 * a}};
  for (const auto& f : {std::array<std::uint32_t, 3>{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}})
    mesh.add_face({f[0], f[1], f[2]});
  const ScenePtr scene = scene_of(mesh);
  Preset preset = all_of(0.008);
  preset.finger.shape = FingerShape::capsule;
  preset.finger.half_length_m = 0.010;
  Leaps leaps;
  for (int from = 0; from < 25; ++from) {
    std::vector<Vec3> way;
    for (int i = 0; i < 160; ++i) way.emplace_back(4e-4 * from, 1e-3, -0.012 + 1.5e-4 * i);
    const Leaps more = leaps_over(scene, preset, way);
    leaps.marked += more.marked, leaps.unmarked += more.unmarked;
  }
  CHECK(leaps.marked >= 10);
  CHECK(leaps.unmarked == 0);
}

TEST_CASE("while several places push a tick that finds no contact ramps from the force of all of them") {
  const Preset preset = all_of(0.005);
  Stepper stepper(walls(2));
  TickState state;
  TickOutput last;
  int leaps = 0, reached = 0;
  for (int i = 0; i < 60; ++i) {
    TickInput input = at_position(1e-3 * i, {0.004, 0.0037, 0.0});
    input.unready = i >= 20 && i < 40;  // as where parts of a large mesh are not built yet
    const TickOutput out = stepper.step(preset, input, state);
    const double before = glm::length(last.force_n), now = glm::length(out.force_n);
    if (input.unready) {  // the direction stays, or turns as slowly as a fade; the length goes with the ramp
      const Vec3 shorter = before > 0.0 ? std::min(1.0, now / before) * last.force_n : Vec3(0.0);
      leaps += glm::distance(out.force_n, shorter) > 1e-3 * kForceFade + 1e-9;
      const double share = unconverged_share(preset.safety, 1e-3 * (i - 19)),
                   step = 1e-3 / preset.safety.unconverged_ramp_s;
      if (share < 1.0) leaps += now < before * share / std::min(1.0, share + step) - 1e-3 * kForceFade - 1e-9;
      reached += out.force_n == Vec3(0.0);
    } else {
      leaps += i > 0 && glm::distance(out.force_n, last.force_n) > 1e-3 * kForceFade + 1e-9;
    }
    last = out;
  }
  CHECK(leaps == 0);
  CHECK(reached == 11);  // from 10 ms after the last contact on
}

namespace {

/// Forces of 40 ticks without a contact, `change` before them, after 20 between two walls.
template <class Change>
std::vector<Vec3> ramp_after(Preset preset, const Vec3& way_per_tick, const Change& change) {
  Stepper stepper(walls(2));
  TickState state;
  std::vector<Vec3> forces;
  Vec3 at(0.004, 0.0037, 0.0);
  for (int i = 0; i < 60; ++i) {
    if (i == 20) change(preset);
    if (i >= 20) at += way_per_tick;
    TickInput input = at_position(1e-3 * i, at);
    input.unready = i >= 20;
    const TickOutput out = stepper.step(preset, input, state);
    if (i == 19) REQUIRE(glm::length(out.force_n) > 1.0);
    if (i >= 20) forces.push_back(out.force_n);
  }
  return forces;
}

}  // namespace

TEST_CASE("a lower limit of force holds at once in a ramp, too") {
  Preset preset = all_of(0.005);
  preset.safety.unconverged_ramp_s = 0.1;
  for (const Vec3& force : ramp_after(preset, Vec3(0.0), [](Preset& p) { p.force.limit_n = 0.3; }))
    CHECK(glm::length(force) <= 0.3 + 1e-12);
}

TEST_CASE("a finger that leaves while the force ramps feels none in free air") {
  Preset preset = all_of(0.005);
  preset.safety.unconverged_ramp_s = 1.0;
  const std::vector<Vec3> forces = ramp_after(preset, {3e-4, 3e-4, 0.0}, [](Preset&) {});
  for (std::size_t i = 8; i < forces.size(); ++i) CHECK(forces[i] == Vec3(0.0));  // 1.3 mm deep at the most
}

TEST_CASE("a place that does not count, since it is far from touched, is not searched for at every tick") {
  // Behind a sheet that it has not entered, the finger goes in over the floor of another, 7 mm under its centre.
  PolygonMesh sheets;
  sheets.name = "two sheets";
  for (const Vec3& at : {Vec3(-0.030, -0.020, 0.0), Vec3(0.0, -0.020, -0.0115)}) {
    const auto first = static_cast<std::uint32_t>(sheets.positions.size());
    for (const Vec3& corner : {Vec3(0.0), Vec3(0.060, 0.0, 0.0), Vec3(0.060, 0.040, 0.0), Vec3(0.0, 0.040, 0.0)})
      sheets.positions.push_back(at + corner);
    sheets.add_face({first, first + 1, first + 2});
    sheets.add_face({first, first + 2, first + 3});
  }
  Stepper stepper(scene_of(sheets));
  TickState state;
  const Preset preset = all_of(0.005);
  int beside = 0, known = 0, pushed = 0;
  for (int i = 0; i < 400; ++i) {
    const double x = -0.020 + 1e-4 * i;
    const TickOutput out = stepper.step(preset, at_position(1e-3 * i, {x, 0.0, -0.0045}), state);
    if (i == 0) state.unentered = 1;  // as where it was come upon from behind
    REQUIRE(state.unentered == 1);
    pushed += i > 0 && out.decided_force_n != Vec3(0.0);
    if (x < 0.0) continue;
    ++beside;
    known += state.clearance.margin_m > 0.0;
  }
  CHECK(beside == 200);
  CHECK(known > 180);
  CHECK(pushed == 0);
}
