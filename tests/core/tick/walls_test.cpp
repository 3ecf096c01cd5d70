// Inner edges that a finger is pressed into so deep that, seen from its place, a wall has ended: it pushes all the
// same.
#include "core/tick/walls.h"
#include "tests/core/fingers.h"
#include "tests/core/inner_corner.h"

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kStiffness = 800.0;  // N/m, the default

Preset all_push(const Finger& finger) {
  Preset preset = sphere_preset(finger.radius_m, Method::robust);
  preset.finger = finger;
  preset.force.contacts = ForceContacts::all;
  return preset;
}

Finger ball(double radius_m) {
  Finger finger;
  finger.shape = FingerShape::sphere;
  finger.radius_m = radius_m;
  return finger;
}

/// Of a finger in two planes through 0.
Vec3 way_out_of_both(const Finger& finger, const Vec3& at, const Vec3& n1, const Vec3& n2) {
  const FingerPose pose{at, Quat(1.0, 0.0, 0.0, 0.0)};
  const double p1 = contact_on_plane(finger, pose, Vec3(0.0), n1).penetration_m;
  const double p2 = contact_on_plane(finger, pose, Vec3(0.0), n2).penetration_m;
  const double c = glm::dot(n1, n2), along1 = p1 - c * p2, along2 = p2 - c * p1;
  if (std::max(p1, p2) > 0.0 && along1 > 0.0 && along2 > 0.0) return (along1 * n1 + along2 * n2) / (1.0 - c * c);
  return p1 > p2 ? std::max(0.0, p1) * n1 : std::max(0.0, p2) * n2;
}

/// Counts what a finger feels on a way.
struct Felt {
  int facing = 0, unconverged = 0, marked = 0, reseeded = 0, unmarked_leaps = 0;
  double worst_n = 0.0;
};
template <class Wanted>
Felt feel(const ScenePtr& scene, const Preset& preset, const std::vector<Vec3>& way, Wanted wanted) {
  Felt felt;
  Stepper stepper(scene);
  TickState state;
  TickOutput last;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const TickOutput out = stepper.step(preset, at_position(1e-3 * static_cast<double>(i), way[i]), state);
    felt.facing += out.status == TickStatus::facing;
    felt.unconverged += out.status == TickStatus::unconverged;
    felt.marked += i > 0 && out.event != TickEvent::none;
    felt.reseeded += i > 0 && out.event == TickEvent::reseed;
    felt.worst_n = std::max(felt.worst_n, glm::distance(out.decided_force_n, wanted(way[i])));
    if (i > 0 && out.event == TickEvent::none) {
      const double explained = 3.0 * glm::distance(way[i], way[i - 1]) + 3e-5;
      felt.unmarked_leaps += glm::distance(out.decided_force_n, last.decided_force_n) > kStiffness * explained;
    }
    last = out;
  }
  return felt;
}

/// To and fro in an inner edge at `step` a tick, between places as deep as `deepest` of either wall.
std::vector<Vec3> way_inside(const InnerCorner& corner, double deepest, double furthest, double step, int ticks) {
  Random random(31);
  const auto place = [&] {
    for (;;) {
      const Vec3 at = Vec3(random.in(-furthest, furthest), random.in(-0.01, 0.01), random.in(-furthest, furthest));
      if (glm::dot(at, corner.first) > -deepest && glm::dot(at, corner.second) > -deepest) return at;
    }
  };
  std::vector<Vec3> way{0.9 * furthest * unit(corner.first + corner.second)};
  for (Vec3 target = place(); way.size() < static_cast<std::size_t>(ticks);) {
    if (glm::distance(way.back(), target) < step) target = place();
    way.push_back(way.back() + step * unit(target - way.back()));
  }
  return way;
}

}  // namespace

TEST_CASE("wherever a ball is in an inner edge, it is pushed the shortest way out of both walls") {
  for (const double opening : {60.0, 90.0, 120.0, 130.0})
    for (const int cells : {1, 16}) {
      const InnerCorner corner(opening * kDegree);
      const ScenePtr scene = corner.scene(cells);
      const Finger finger = ball(0.004);
      const auto way = way_inside(corner, 0.002, 0.005, 2e-5, rounds(20000));
      const Felt felt = feel(scene, all_push(finger), way, [&](const Vec3& at) {
        return kStiffness * way_out_of_both(finger, at, corner.first, corner.second);
      });
      CAPTURE(opening);
      CAPTURE(cells);
      CHECK(felt.worst_n < kStiffness * 5e-6);
      CHECK(felt.facing + felt.unconverged == 0);
      CHECK(felt.reseeded == 0);
      CHECK(felt.unmarked_leaps == 0);
      CHECK(felt.marked < static_cast<int>(way.size()) / 100);
    }
}

TEST_CASE("a ball presses straight into an inner edge without a reseed, and its force is that of both walls") {
  const InnerCorner corner(90.0 * kDegree);
  const ScenePtr scene = corner.scene(16);
  const Finger finger = ball(0.002);
  std::vector<Vec3> way;
  for (int i = 0; i < 600; ++i) way.emplace_back(0.002 - 5e-6 * i, 0.004, 0.002 - 5e-6 * i);
  const Felt felt = feel(scene, all_push(finger), way, [&](const Vec3& at) {
    return kStiffness * way_out_of_both(finger, at, corner.first, corner.second);
  });
  CHECK(felt.worst_n < kStiffness * 3e-6);
  CHECK(felt.facing == 0);
  CHECK(felt.reseeded == 0);
  CHECK(felt.marked <= 2);  // the display turns
}

TEST_CASE(
    "an ellipsoid or capsule pressed into an inner edge deeper than it reaches is held, and no leap is unmarked") {
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule})
    for (const double opening : {60.0, 90.0, 120.0}) {
      const InnerCorner corner(opening * kDegree);
      const ScenePtr scene = corner.scene(16);
      Finger finger = finger_of(shape);
      finger.semi_axes_m = {0.006, 0.004, 0.003};
      finger.radius_m = 0.003;
      finger.half_length_m = 0.003;
      std::vector<Vec3> way;
      const Vec3 inwards = -unit(corner.first + corner.second);
      for (int i = 0; i < 1200; ++i) way.push_back(Vec3(0.0, 0.004, 0.0) + (1e-5 * i - 0.010) * inwards);
      const Felt felt = feel(scene, all_push(finger), way, [&](const Vec3& at) {
        return kStiffness * way_out_of_both(finger, at, corner.first, corner.second);
      });
      CAPTURE(static_cast<int>(shape));
      CAPTURE(opening);
      CHECK(felt.facing + felt.unconverged == 0);
      CHECK(felt.reseeded == 0);
      CHECK(felt.unmarked_leaps == 0);
      if (opening >= 90.0) CHECK(felt.worst_n < kStiffness * 1e-5);
      const auto anywhere = way_inside(corner, 0.002, 0.006, 2e-5, rounds(20000));
      const Felt all = feel(scene, all_push(finger), anywhere, [](const Vec3&) { return Vec3(0.0); });
      CHECK(all.facing + all.unconverged == 0);
      CHECK(all.unmarked_leaps == 0);
    }
}

TEST_CASE("in the corner of three walls no finger is without a contact, and no leap is unmarked") {
  PolygonMesh mesh;  // inside of a box: the corner at 0, walls x = 0, y = 0, z = 0
  const double a = 0.05;
  mesh.positions = {{0, 0, 0}, {a, 0, 0}, {0, a, 0}, {a, a, 0}, {0, 0, a}, {a, 0, a}, {0, a, a}};
  for (const auto& f : {std::array<std::uint32_t, 4>{0, 1, 3, 2}, {0, 4, 5, 1}, {0, 2, 6, 4}}) {
    mesh.add_face({f[0], f[1], f[2]});
    mesh.add_face({f[0], f[2], f[3]});
  }
  const ScenePtr scene = scene_of(mesh);
  for (const FingerShape shape : {FingerShape::sphere, FingerShape::ellipsoid, FingerShape::capsule}) {
    Finger finger = finger_of(shape);
    finger.semi_axes_m = {0.006, 0.004, 0.003};
    finger.radius_m = 0.003;
    finger.half_length_m = 0.003;
    Random random(33);
    std::vector<Vec3> way{Vec3(0.006)};
    for (Vec3 to = way.back(); way.size() < static_cast<std::size_t>(rounds(20000));) {
      if (glm::distance(way.back(), to) < 2e-5)
        to = {random.in(-0.002, 0.006), random.in(-0.002, 0.006), random.in(-0.002, 0.006)};
      way.push_back(way.back() + 2e-5 * unit(to - way.back() + Vec3(1e-12)));
    }
    const Felt felt = feel(scene, all_push(finger), way, [](const Vec3&) { return Vec3(0.0); });
    CAPTURE(static_cast<int>(shape));
    CHECK(felt.facing + felt.unconverged == 0);
    CHECK(felt.unmarked_leaps == 0);
    CHECK(felt.marked < static_cast<int>(way.size()) / 50);
    CHECK(felt.reseeded == 0);
  }
}
