// For any mesh and pose: no NaN in the output, no crash, and the next good tick works.
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::array<Method, 5> kMethods{Method::paper, Method::newton, Method::robust, Method::facet,
                                         Method::force_shading};
constexpr std::array<FingerShape, 4> kShapes{FingerShape::point, FingerShape::sphere, FingerShape::ellipsoid,
                                             FingerShape::capsule};

ScenePtr icosphere() {
  static const ScenePtr scene = scene_of(make_icosphere(0.040, 2));
  return scene;
}

Preset preset_of(Method method, FingerShape shape, double size) {
  Preset preset = sphere_preset(size, method);
  preset.finger.shape = shape;
  preset.finger.radius_m = size;
  preset.finger.semi_axes_m = size * Vec3(1.5, 1.0, 0.8);
  preset.finger.half_length_m = size;
  return preset;
}

bool state_is_finite(const TickState& s) {
  return is_finite(s.plane.point) && is_finite(s.plane.normal) && std::isfinite(s.plane.u) &&
         std::isfinite(s.plane.v) && is_finite(s.last_converged.point) && is_finite(s.last_converged.normal);
}

/// Ticks whose output or state isn't finite, whose normal isn't unit, or that claim a contact with an error over the
/// tolerance.
struct Faults {
  int not_finite = 0, not_unit = 0, untrue = 0, unconverged = 0, ticks = 0;
  void add(const Preset& preset, const TickOutput& out, const TickState& state) {
    ++ticks;
    not_finite += !all_finite(out) || !state_is_finite(state);
    not_unit += !(std::abs(glm::length(out.normal) - 1.0) < 1e-9);
    unconverged += out.status == TickStatus::unconverged;
    untrue += is_converged(out.status) && !(out.error_m < preset.solver.tolerance_m);
    untrue += !(glm::length(out.force_n) <= preset.force.limit_n * (1.0 + 1e-12));
    untrue += !(std::abs(out.cld_m) <= 0.5 * preset.display.travel_m * (1.0 + 1e-12));
  }
  void check() const {
    CHECK(not_finite == 0);
    CHECK(not_unit == 0);
    CHECK(untrue == 0);
  }
};

/// Random poses all over and in the mesh, every fourth a leap. Fingers that are not round search longer and get fewer.
Faults random_poses(const ScenePtr& scene, int poses, std::uint64_t seed, const std::vector<Method>& methods) {
  Faults faults;
  Random random(seed);
  const ContactMesh& mesh = scene->mesh();
  const double size = glm::length(mesh.bounds().size());
  for (const Method method : methods)
    for (const FingerShape shape : kShapes) {
      const bool round = shape == FingerShape::point || shape == FingerShape::sphere;
      Preset preset = preset_of(method, shape, random.in(0.02, 0.5) * size);
      preset.solver.tolerance_m = 1e-5 * size;
      Stepper stepper(scene);
      TickState state;
      Vec3 centre(0.0);
      for (int i = 0; i < (round ? poses : poses / 20); ++i) {
        centre = i % 4 ? centre + random.in_cube(0.002 * size) : random.in_cube(0.7 * size);
        const TickOutput out = stepper.step(preset, {1e-3 * i, {mesh.origin() + centre, random.orientation()}}, state);
        faults.add(preset, out, state);
      }
    }
  return faults;
}

const std::vector<Method> kAllMethods(kMethods.begin(), kMethods.end());

}  // namespace

TEST_CASE("a pose that is not finite gives an unconverged tick without NaN, and the next good tick works") {
  for (const Method method : kMethods)
    for (const FingerShape shape : kShapes) {
      CAPTURE(name_of(method));
      CAPTURE(static_cast<int>(shape));
      const Preset preset = preset_of(method, shape, 0.020);
      for (const double bad : {kNan, kInf, -kInf}) {
        for (int where = 0; where < 7; ++where) {
          Stepper stepper(icosphere());
          TickState state;
          const auto good = [&](double t) { return stepper.step(preset, at_position(t, {0.0, 0.001, 0.057}), state); };
          const TickOutput before = good(0.0);
          const TickState kept = state;
          FingerPose pose{{0.0, 0.001, 0.057}, Quat(1.0, 0.0, 0.0, 0.0)};
          double* parts[7] = {&pose.position.x,    &pose.position.y,    &pose.position.z,   &pose.orientation.w,
                              &pose.orientation.x, &pose.orientation.y, &pose.orientation.z};
          *parts[where] = bad;
          const TickOutput out = stepper.step(preset, {1e-3, pose}, state);
          CHECK(out.status == TickStatus::unconverged);
          CHECK(all_finite(out));
          CHECK(state_is_finite(state));
          CHECK(state.plane.triangle == kept.plane.triangle);
          const TickOutput after = good(2e-3);
          CHECK(after.status == before.status);
          CHECK(glm::length(after.contact - before.contact) <= 2e-6);
          CHECK(all_finite(after));
        }
      }
    }
}

TEST_CASE("a time that is not finite or runs backwards puts no NaN into the force") {
  Preset preset = preset_of(Method::robust, FingerShape::sphere, 0.020);
  preset.force.damping_n_s_per_m = 10.0;
  for (const double bad : {kNan, kInf, -kInf, -1e9}) {
    Stepper stepper(icosphere());
    TickState state;
    stepper.step(preset, at_position(0.0, {0.0, 0.0, 0.059}), state);
    CHECK(all_finite(stepper.step(preset, at_position(bad, {0.0, 0.0, 0.0589}), state)));
    CHECK(all_finite(stepper.step(preset, at_position(bad, {0.0, kNan, 0.0589}), state)));
    const TickOutput after = stepper.step(preset, at_position(0.002, {0.0, 0.0, 0.059}), state);
    CHECK(all_finite(after));
    CHECK(after.status == TickStatus::face);
  }
}

TEST_CASE("a zero or unnormalised quaternion puts out no NaN, and the next good tick works") {
  for (const Method method : kMethods)
    for (const FingerShape shape : {FingerShape::point, FingerShape::sphere})
      for (const double scale : {0.0, 1e-200, 1e-3, 5.0}) {
        const Preset preset = preset_of(method, shape, 0.020);
        Stepper stepper(icosphere());
        TickState state;
        const FingerPose pose{{0.0, 0.001, 0.057}, scale * Quat(0.5, 0.5, 0.5, 0.5)};
        Faults faults;
        faults.add(preset, stepper.step(preset, {0.0, pose}, state), state);
        faults.add(preset, stepper.step(preset, at_position(1e-3, {0.0, 0.001, 0.057}), state), state);
        faults.check();
        CHECK(faults.unconverged <= 1);
      }
}

TEST_CASE("a zero or unnormalised quaternion puts out no NaN with long fingers either") {
  for (const Method method : kMethods)
    for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule})
      for (const double scale : {0.0, 1e-200, 1e-3, 5.0}) {
        CAPTURE(name_of(method));
        CAPTURE(static_cast<int>(shape));
        CAPTURE(scale);
        const Preset preset = preset_of(method, shape, 0.020);
        Stepper stepper(icosphere());
        TickState state;
        const FingerPose pose{{0.0, 0.001, 0.057}, scale * Quat(0.5, 0.5, 0.5, 0.5)};
        const TickOutput out = stepper.step(preset, {0.0, pose}, state);
        CHECK(all_finite(out));
        CHECK(state_is_finite(state));
        const TickOutput after = stepper.step(preset, at_position(1e-3, {0.0, 0.001, 0.057}), state);
        CHECK(all_finite(after));
        if (method == Method::robust) CHECK(after.status != TickStatus::unconverged);
      }
}

TEST_CASE(
    "robust converges at every vertex, on every edge, on faces, at the centre and close to the surface of an "
    "icosphere") {
  const ContactMesh& mesh = icosphere()->mesh();
  std::vector<Vec3> poses{Vec3(0.0), {1e-12, 0.0, 0.0}};
  for (std::uint32_t t = 0; t < mesh.triangle_count(); t += testing::kSanitized ? 7 : 1) {
    const auto p = mesh.positions(t);
    for (const Vec3& on : {p[0], 0.5 * (p[0] + p[1]), 0.25 * p[0] + 0.75 * p[2], (p[0] + p[1] + p[2]) / 3.0})
      for (const double off : {0.0, 1e-12, -1e-12, 1e-6}) poses.push_back(on + off * unit(on));
  }
  for (const FingerShape shape : kShapes) {
    CAPTURE(static_cast<int>(shape));
    const Preset preset = preset_of(Method::robust, shape, 0.010);
    Faults cold, warm;
    Stepper stepper(icosphere());
    TickState warm_state;
    for (const Vec3& p : poses) {
      TickState state;
      cold.add(preset, stepper.step(preset, at_position(0.0, p), state), state);
      warm.add(preset, stepper.step(preset, at_position(0.0, p), warm_state), warm_state);
    }
    cold.check();
    warm.check();
    CHECK(cold.unconverged == 0);
    CHECK(warm.unconverged == 0);
  }
}

TEST_CASE("the other methods put out no NaN at vertices, on edges and faces, at the centre") {
  const ContactMesh& mesh = icosphere()->mesh();
  for (const Method method : kMethods)
    for (const FingerShape shape : kShapes) {
      const Preset preset = preset_of(method, shape, 0.010);
      Faults faults;
      Stepper stepper(icosphere());
      TickState state;
      faults.add(preset, stepper.step(preset, at_position(0.0, Vec3(0.0)), state), state);
      for (std::uint32_t t = 0; t < mesh.triangle_count(); t += 3) {
        const auto p = mesh.positions(t);
        for (const Vec3& on : {p[0], 0.5 * (p[0] + p[1]), (p[0] + p[1] + p[2]) / 3.0})
          faults.add(preset, stepper.step(preset, at_position(0.0, on), state), state);
      }
      CAPTURE(name_of(method));
      faults.check();
    }
}

TEST_CASE("far away, up to the end of a double's range, no NaN comes out, and coming back works") {
  for (const Method method : kMethods)
    for (const FingerShape shape : kShapes)
      for (const double far : {1.0, 1e3, 1e6, 1e12, 1e30, 1e100}) {
        CAPTURE(name_of(method));
        CAPTURE(static_cast<int>(shape));
        CAPTURE(far);
        const Preset preset = preset_of(method, shape, 0.020);
        Stepper stepper(icosphere());
        TickState state;
        Faults faults;
        const TickOutput away = stepper.step(preset, at_position(0.0, far * unit(Vec3(0.3, -0.5, 0.8))), state);
        CHECK(all_finite(away));
        CHECK(state_is_finite(state));
        CHECK(glm::length(away.force_n) == 0.0);
        if (far <= 1e6 && method == Method::robust && shape == FingerShape::sphere) {
          CHECK(away.status == TickStatus::free);
          CHECK(std::abs(away.penetration_m - (0.060 - far)) <= 2e-5 + 1e-12 * far);  // the patches' bulge error
        }
        const TickOutput back = stepper.step(preset, at_position(1e-3, {0.0, 0.001, 0.057}), state);
        CHECK(all_finite(back));
        if (method == Method::robust) CHECK(back.status != TickStatus::unconverged);
      }
}

TEST_CASE("the same pose twice takes no iteration the second time and gives the same contact") {
  Random random(90);
  for (const ScenePtr& scene : {icosphere(), scene_of(*generate_mesh("octagon"))})
    for (const Method method : kSmoothMethods)
      for (const FingerShape shape : kShapes) {
        CAPTURE(name_of(method));
        CAPTURE(static_cast<int>(shape));
        Preset preset = preset_of(method, shape, 0.010);
        preset.solver.gain_curvature_m = 0.03;
        preset.solver.max_iterations = 300;
        Stepper stepper(scene);
        int more = 0, moved = 0, tried = 0;
        for (int i = 0; i < 50; ++i) {
          TickState state;
          const FingerPose pose{0.048 * random.direction(), Quat(1.0, 0.0, 0.0, 0.0)};
          // The first ticks may find deeper places and switch to them.
          TickOutput first = stepper.step(preset, {0.0, pose}, state);
          for (int k = 0; k < 4; ++k) first = stepper.step(preset, {1e-3, pose}, state);
          const TickOutput second = stepper.step(preset, {2e-3, pose}, state);
          if (first.status == TickStatus::unconverged) continue;
          ++tried;
          more += second.iterations != 0;
          moved += second.triangle != first.triangle || second.u != first.u || second.v != first.v ||
                   second.event != TickEvent::none;
        }
        CHECK(tried > 25);
        CHECK(more == 0);
        CHECK(moved == 0);
      }
}

TEST_CASE("duplicate vertices, as in STL, change no contact") {
  const PolygonMesh welded = make_icosphere(0.040, 2);
  const auto a = scene_of(welded), b = scene_of(sample::unwelded(welded));
  Random random(91);
  for (const Method method : kSmoothMethods) {
    const Preset preset = preset_of(method, FingerShape::sphere, 0.020);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = 0.059 * random.direction();
      CHECK(glm::length(solve_once(a, preset, p).contact - solve_once(b, preset, p).contact) <= 1e-12);
    }
  }
}

TEST_CASE("needle triangles of aspect 1e5 are slid over without NaN or failure") {
  // A plate of 80 needles, 0.1 m long and 1 um wide, in the middle of an ordinary one.
  PolygonMesh mesh;
  mesh.name = "needles";
  std::vector<double> columns{-0.05};
  for (int i = 0; i <= 80; ++i) columns.push_back(1e-6 * (i - 40));
  columns.push_back(0.05);
  for (const double x : columns) {
    mesh.positions.emplace_back(x, -0.05, 0.0);
    mesh.positions.emplace_back(x, 0.05, 0.0);
  }
  for (std::uint32_t i = 0; i + 1 < columns.size(); ++i) {
    mesh.add_face({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.add_face({2 * i, 2 * i + 3, 2 * i + 1});
  }
  const auto scene = scene_of(mesh);
  REQUIRE(scene->mesh().usable_triangle_count() == scene->mesh().triangle_count());
  for (const Method method : kSmoothMethods)
    for (const FingerShape shape : kShapes) {
      CAPTURE(name_of(method));
      CAPTURE(static_cast<int>(shape));
      const Preset preset = preset_of(method, shape, 0.010);
      Stepper stepper(scene);
      TickState state;
      Faults faults;
      double off = 0.0;
      for (int i = 0; i < 2000; ++i) {
        const double x = i < 1000 ? -0.0001 + 2e-7 * i : 0.02 * std::sin(0.05 * i);
        const Vec3 p(x, 0.01 * std::sin(0.01 * i), 0.0079);
        const TickOutput out = stepper.step(preset, at_position(1e-3 * i, p), state);
        faults.add(preset, out, state);
        off = std::max(off, std::abs(out.contact.x - p.x) + std::abs(out.contact.z));
      }
      faults.check();
      CHECK(faults.unconverged == 0);
      CHECK(off <= 2e-6);
    }
}

TEST_CASE("normals that are zero, not finite, reversed or all over the place put out no NaN") {
  Random random(92);
  for (int kind = 0; kind < 4; ++kind) {
    PolygonMesh mesh = make_icosphere(0.040, 1);
    mesh.corner_normal.clear();
    mesh.normals.clear();
    for (std::size_t i = 0; i < mesh.corner_position.size(); ++i) {
      const Vec3 n = kind == 0   ? Vec3(0.0)
                     : kind == 1 ? (i % 2 ? Vec3(kNan) : unit(mesh.positions[mesh.corner_position[i]]))
                     : kind == 2 ? (i % 3 ? 1.0 : -1.0) * unit(mesh.positions[mesh.corner_position[i]])
                                 : random.direction();
      mesh.corner_normal.push_back(static_cast<std::uint32_t>(mesh.normals.size()));
      mesh.normals.push_back(n);
    }
    CAPTURE(kind);
    random_poses(scene_of(mesh), rounds(1000), 93, kAllMethods).check();
  }
}

TEST_CASE("one triangle, a Moebius strip, a bow tie and two plates back to back put out no NaN") {
  PolygonMesh bow_tie =
      sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0.3}}, {{0, 1, 2}, {0, 3, 4}});
  PolygonMesh back_to_back = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  PolygonMesh one = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const PolygonMesh& mesh : {one, sample::moebius(24), bow_tie, back_to_back, sample::cube(),
                                  sample::grid(3, [](double x, double y) { return x * y; })}) {
    const Faults faults = random_poses(scene_of(mesh), rounds(2000), 94, kAllMethods);
    faults.check();
  }
}

TEST_CASE("robust always finds a contact with the sphere finger on one triangle, a Moebius strip and sharp bodies") {
  PolygonMesh one = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const PolygonMesh& mesh :
       {one, sample::moebius(24), sample::cube(), *generate_mesh("octagon"), *generate_mesh("cone")}) {
    const auto scene = scene_of(mesh);
    const double size = glm::length(scene->mesh().bounds().size());
    Preset preset = preset_of(Method::robust, FingerShape::sphere, 0.1 * size);
    preset.solver.tolerance_m = 1e-5 * size;
    Random random(95);
    Stepper stepper(scene);
    int unconverged = 0;
    for (int i = 0; i < rounds(2000); ++i) {
      TickState state;
      unconverged +=
          stepper.step(preset, at_position(0.0, scene->mesh().origin() + random.in_cube(size)), state).status ==
          TickStatus::unconverged;
    }
    CAPTURE(mesh.positions.size());
    CHECK(unconverged == 0);
  }
}

TEST_CASE("a million random poses on random triangle soups put out no NaN") {
  Faults all;
  int soups = 0;
  for (std::uint32_t seed = 0; seed < 60 && soups < 40; ++seed) {
    auto built = ContactMesh::build(sample::soup(seed, 4 + static_cast<int>(seed % 20), 3 + static_cast<int>(seed)));
    if (!built) continue;
    ++soups;
    auto scene = ContactScene::build(std::move(*built));
    REQUIRE(scene.has_value());
    const Faults f = random_poses(*scene, rounds(12000), seed, {Method::robust});
    all.not_finite += f.not_finite, all.not_unit += f.not_unit, all.untrue += f.untrue;
    all.ticks += f.ticks, all.unconverged += f.unconverged;
  }
  MESSAGE(all.ticks << " ticks of robust on " << soups << " soups, " << all.unconverged << " unconverged");
  all.check();
  CHECK(soups == 40);
}

TEST_CASE("random poses with the other methods on random triangle soups put out no NaN") {
  Faults all;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    auto built = ContactMesh::build(sample::soup(seed, 4 + static_cast<int>(seed % 20), 3 + static_cast<int>(seed)));
    if (!built) continue;
    auto scene = ContactScene::build(std::move(*built));
    const Faults f =
        random_poses(*scene, rounds(500), seed, {Method::paper, Method::newton, Method::facet, Method::force_shading});
    all.not_finite += f.not_finite, all.not_unit += f.not_unit, all.untrue += f.untrue, all.ticks += f.ticks;
  }
  all.check();
}
