#include "core/lab/objects/generate.h"
#include "workbench/bench/bench_case.h"
#include "workbench/bench/case_paths.h"

namespace tangent::bench {

namespace {

constexpr double kStrokeSpeed = 0.1, kStrokePress = 1e-3, kRounding = 1.5e-3, kFingerRadius = 0.020;

}  // namespace

std::vector<BenchCase> stroke_cases() {
  std::vector<BenchCase> cases;
  for (const char* object : {"sphere", "cone", "cylinder", "cube", "tetrahedron", "octagon", "triangle"}) {
    BenchCase c;
    c.name = std::string(object) + "_strokes";
    c.what = std::string(object) + ", edges rounded by 1.5 mm, left and right, then forward and back";
    const double rounding = c.name.starts_with("sphere") ? 0.0 : kRounding;
    c.mesh = [=] { return generate_mesh(object, {.rounding_m = rounding}); };
    c.preset.finger.radius_m = kFingerRadius;
    c.preset.solver.gain_overall = 1.0;
    c.preset.solver.gain_curvature_m = kFingerRadius - kStrokePress;
    c.preset.solver.gain_distance_per_m = 0.0;
    c.own_gains = true;
    c.poses = [](const ContactScene& scene, const Finger& finger, int ticks) {
      return stroke(scene, finger, kStrokeSpeed, kStrokePress, ticks);
    };
    cases.push_back(std::move(c));
  }
  return cases;
}

std::vector<BenchCase> paper_cases() {
  std::vector<BenchCase> cases;
  const auto add = [&](const std::string& object, double rounding, const std::string& name, const std::string& what) {
    BenchCase c;
    c.name = name;
    c.what = what;
    c.mesh = [=] { return generate_mesh(object, {.rounding_m = rounding}); };
    c.preset.finger.radius_m = kFingerRadius;
    c.poses = [=](const ContactScene& scene, const Finger& finger, int ticks) {
      return explore(scene, finger, kStrokeSpeed, kStrokePress, ticks);
    };
    cases.push_back(std::move(c));
  };
  add("sphere", 0.0, "icosphere_320", "icosphere of 320 triangles, radius 40 mm");
  cases.back().poses = [](const ContactScene& scene, const Finger& finger, int ticks) {
    return around_ball(scene.mesh().origin(), 0.040 + finger.radius_m - kStrokePress, kStrokeSpeed, ticks);
  };
  const std::vector<std::string> objects{"cone", "cylinder", "cube", "tetrahedron", "octagon", "triangle", "hexagon"};
  for (const std::string& object : objects)
    add(object, kRounding, object + "_rounded", object + ", edges rounded by 1.5 mm");
  for (const std::string& object : objects) add(object, 0.0, object + "_sharp", object + " with sharp edges");
  return cases;
}

Result<ScenePtr> build_scene(const BenchCase& bench_case) {
  const Result<PolygonMesh> source = bench_case.mesh();
  if (!source) return tl::unexpected(source.error());
  Result<ContactMesh> mesh = ContactMesh::build(*source, bench_case.options);
  if (!mesh) return tl::unexpected(mesh.error());
  return ContactScene::build(std::move(*mesh));
}

}  // namespace tangent::bench
