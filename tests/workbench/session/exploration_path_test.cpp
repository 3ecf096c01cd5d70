#include "workbench/session/exploration_path.h"

#include "core/io/mesh_io.h"
#include "core/lab/objects/arc.h"
#include "tests/support/approx.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kTick = 0.1 * 1e-3;  // m of way a tick, at 0.1 m/s and 1 kHz

struct Walk {
  double longest_step = 0.0;                ///< m between ticks, of the finger's centre
  double largest_turn = 0.0;                ///< rad between ticks
  double deepest = -1.0, shallowest = 1.0;  ///< penetration of the centre's sphere into the raw mesh, m
  double touching = 0.0;                    ///< share of ticks
};

Walk walk(const ContactScene& scene, double pad, double press) {
  const ExplorationPath path = ExplorationPath::build(scene, pad);
  Walk w;
  PathPose last = path.at(0.0, pad, press);
  const int ticks = static_cast<int>(path.length_m() / kTick) + 10;  // a little more than once around
  for (int i = 1; i <= ticks; ++i) {
    const PathPose pose = path.at(i * kTick, pad, press);
    REQUIRE(is_finite(pose.position_m));
    w.longest_step = std::max(w.longest_step, glm::length(pose.position_m - last.position_m));
    const double half = std::min(1.0, std::abs(glm::dot(pose.orientation, last.orientation)));
    w.largest_turn = std::max(w.largest_turn, 2.0 * std::acos(half));
    const auto hit =
        scene.nearest().nearest(pose.position_m - scene.mesh().origin(), std::numeric_limits<double>::infinity());
    const double depth = pad - hit.distance_m;
    w.deepest = std::max(w.deepest, depth);
    w.shallowest = std::min(w.shallowest, depth);
    w.touching += depth > 0.0;
    last = pose;
  }
  w.touching /= ticks;
  return w;
}

}  // namespace

TEST_CASE("over a sphere the path keeps the asked-for depth") {
  for (const double pad : {0.005, 0.020}) {
    const Walk w = walk(*sphere_scene(), pad, 1e-3);
    // The icosphere's facets lie up to 0.2 mm inside the sphere.
    CHECK(w.deepest < 1.1e-3);
    CHECK(w.shallowest > 0.7e-3);
  }
}

TEST_CASE("the path never leaps and keeps touching, over round, hollow, sharp and open bodies") {
  struct Body {
    std::string name;
    std::shared_ptr<const ContactScene> scene;
  };
  std::vector<Body> bodies{{"sphere", sphere_scene()}, {"torus", torus_scene()}};
  for (const char* name : {"cube", "cone", "tetrahedron", "octagon", "saddle", "groove"}) {
    auto mesh = generate_mesh(name);
    REQUIRE(mesh);
    bodies.push_back({name, scene_of(*mesh)});
  }
  for (const Body& body : bodies) {
    for (const double pad : {0.005, 0.020}) {
      CAPTURE(body.name);
      CAPTURE(pad);
      const Walk w = walk(*body.scene, pad, 1e-3);
      MESSAGE(body.name << " pad " << pad * 1e3 << " mm: longest step " << w.longest_step * 1e3 << " mm, largest turn "
                        << w.largest_turn / kDegree << " deg, depth " << w.shallowest * 1e3 << " to " << w.deepest * 1e3
                        << " mm, touching " << 100.0 * w.touching << " %");
      // The centre moves 0.1 mm a tick; pressing direction and depth may add to that where the normal turns.
      CHECK(w.longest_step < 3.0 * kTick);
      CHECK(w.largest_turn < 1.0 * kDegree);
      CHECK(w.touching > 0.95);
      CHECK(w.deepest < 2.5e-3);
    }
  }
}

namespace {

void check_no_leap(const std::filesystem::path& file) {
  const auto source = read_mesh(file, 1e-3);
  REQUIRE(source);
  ContactMeshOptions options;
  options.fit_m = 0.1;
  auto mesh = ContactMesh::build(*source, options);
  REQUIRE(mesh);
  auto scene = ContactScene::build(std::move(*mesh));
  REQUIRE(scene);
  CAPTURE(file.string());
  const Walk w = walk(**scene, 0.010, 1e-3);
  MESSAGE(file.stem().string() << ": longest step " << w.longest_step * 1e3 << " mm, largest turn "
                               << w.largest_turn / kDegree << " deg, depth " << w.shallowest * 1e3 << " to "
                               << w.deepest * 1e3 << " mm, touching " << 100.0 * w.touching << " %");
  CHECK(w.longest_step < 3.0 * kTick);
  CHECK(w.largest_turn < 1.0 * kDegree);
  CHECK(w.touching > 0.9);
}

}  // namespace

TEST_CASE("the path never leaps over spot") { check_no_leap(testing::spot_file()); }

TEST_CASE("the path never leaps over the fandisk and the bunny" * doctest::skip(testing::kSanitized)) {
  if (!testing::shared_files_there({"meshes/fandisk.obj", "meshes/stanford-bunny.obj"})) return;
  for (const char* file : {"meshes/fandisk.obj", "meshes/stanford-bunny.obj"})
    check_no_leap(testing::shared_file(file));
}

TEST_CASE("the fingerpad faces the surface, within its rocking") {
  const ExplorationPath path = ExplorationPath::build(*sphere_scene(), 0.020);
  double largest = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const PathPose pose = path.at(i * 0.4e-3, 0.020, 1e-3);
    CHECK(glm::length(pose.orientation) == approx(1.0));
    const Vec3 pad = pose.orientation * Vec3(0, 0, -1);
    const double off = std::acos(std::min(1.0, glm::dot(pad, -unit(pose.position_m))));
    largest = std::max(largest, off);
  }
  CHECK(largest < 0.5);
  CHECK(largest > 0.2);  // it does rock, so that the display has something to show
}

TEST_CASE("the path closes, takes any way, and is the same every time") {
  const ExplorationPath path = ExplorationPath::build(*torus_scene(), 0.010);
  const ExplorationPath again = ExplorationPath::build(*torus_scene(), 0.010);
  CHECK(path.length_m() > 0.5);
  for (int i = 0; i < 100; ++i) {
    const double way = i * 0.037;
    const PathPose a = path.at(way, 0.010, 0.0), b = again.at(way, 0.010, 0.0);
    CHECK(std::memcmp(&a, &b, sizeof a) == 0);
    CHECK(glm::length(path.at(way + path.length_m(), 0.010, 0.0).position_m - a.position_m) < 1e-9);
    CHECK(glm::length(path.at(way - 3.0 * path.length_m(), 0.010, 0.0).position_m - a.position_m) < 1e-9);
  }
}

TEST_CASE("a path built for one finger serves a smaller one") {
  const ExplorationPath path = ExplorationPath::build(*sphere_scene(), 0.020);
  for (int i = 0; i < 100; ++i) {
    const Vec3 centre = path.at(i * 0.01, 0.004, 0.0).position_m;
    CHECK(glm::length(centre) == approx(0.044).epsilon(0.01));
  }
}

TEST_CASE("over a 2D scene the path follows the outline in the plane, pad towards it") {
  for (const bool closed : {false, true}) {
    auto curve = PlanarCurve::build(closed ? make_regular_polygon(24, 0.05) : make_paper_arc(9));
    REQUIRE(curve.has_value());
    const auto scene = ContactScene::build(std::move(*curve));
    REQUIRE(scene.has_value());
    Finger finger;
    finger.radius_m = 0.008;
    const ExplorationPath path = ExplorationPath::build(**scene, pad_distance_m(finger));
    Preset preset;
    preset.finger = finger;
    Stepper stepper(*scene);
    TickState state;
    int touching = 0, unconverged = 0;
    const int ticks = static_cast<int>(path.length_m() / 1e-4);
    for (int i = 0; i < ticks; ++i) {
      const PathPose pose = path.at(1e-4 * i, pad_distance_m(finger), 1e-3);
      CHECK(std::abs(pose.position_m.z) < 1e-15);
      const TickOutput out = stepper.step(preset, {1e-3 * i, {pose.position_m, pose.orientation}}, state);
      touching += out.penetration_m > 0.0;
      unconverged += out.status == TickStatus::unconverged;
      CHECK(std::abs(out.cld_m) <= 0.008);
    }
    CHECK(unconverged == 0);
    CHECK(touching > ticks * 9 / 10);
  }
}
