// The result does not depend on unit, position and orientation of the mesh, nor on the numbering of its triangles.
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Run {
  std::vector<TickOutput> ticks;
};

/// The mesh as it is, with computed normals, and a path of finger centres pressed `depth` at its surface.
struct Subject {
  const char* name;
  PolygonMesh mesh;
  std::vector<Vec3> path;
};

/// Slides over the contacts of nearby directions seen from the middle.
std::vector<Vec3> path_over(const PolygonMesh& mesh, double radius, int ticks) {
  const auto scene = scene_of(mesh);
  const double size = glm::length(scene->mesh().bounds().size());
  Random random(40);
  std::vector<Vec3> path;
  Vec3 direction = random.direction(), axis = random.direction();
  for (int i = 0; i < ticks; ++i) {
    if (i % 50 == 0) axis = random.direction();
    direction = unit(direction + 0.004 * glm::cross(axis, direction));
    const Vec3 from = size * direction;
    const auto hit = scene->nearest().cast(from, -direction);
    if (!hit) continue;
    const Vec3 on = from - hit.distance_m * direction;
    const NearestHit nearest = scene->nearest().nearest(on + radius * direction, size);
    path.push_back(scene->mesh().origin() + nearest.point +
                   (radius - 5e-4) * unit(on + radius * direction - nearest.point));
  }
  return path;
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  all.push_back({"icosphere", make_icosphere(0.040, 2), {}});
  all.push_back({"torus", make_torus(0.040, 0.015, 48, 24), {}});
  all.push_back({"rounded cube", *generate_mesh("cube", {.rounding_m = 1.5e-3}), {}});
  all.push_back({"sharp octagon", *generate_mesh("octagon"), {}});
  for (Subject& s : all) s.path = path_over(s.mesh, 0.020, 400);
  return all;
}

Preset scaled(Preset p, double scale) {
  p.finger.radius_m *= scale;
  p.finger.semi_axes_m *= scale;
  p.finger.half_length_m *= scale;
  p.solver.gain_curvature_m *= scale;
  p.solver.gain_distance_per_m /= scale;
  p.solver.tolerance_m *= scale;
  p.solver.switch_hysteresis_m *= scale;
  return p;
}

std::vector<TickOutput> run(const ScenePtr& scene, const Preset& preset, const std::vector<Vec3>& path,
                            double scale = 1.0, const Vec3& move = Vec3(0.0),
                            const Quat& turn = Quat(1.0, 0.0, 0.0, 0.0)) {
  Stepper stepper(scene);
  TickState state;
  std::vector<TickOutput> ticks;
  for (const Vec3& p : path)
    ticks.push_back(
        stepper.step(preset, {1e-3 * static_cast<double>(ticks.size()), {scale * (turn * p) + move, turn}}, state));
  return ticks;
}

PolygonMesh transformed(PolygonMesh mesh, double scale, const Vec3& move, const Quat& turn) {
  for (Vec3& p : mesh.positions) p = scale * (turn * p) + move;
  for (Vec3& n : mesh.normals) n = turn * n;
  return mesh;
}

const Quat kNoTurn(1.0, 0.0, 0.0, 0.0);

Preset base_preset(Method method) {
  Preset preset = sphere_preset(0.020, method);
  preset.solver.max_iterations = 200;
  preset.solver.gain_distance_per_m = 2.0;
  return preset;
}

struct Difference {
  int ticks = 0, iterations = 0, status = 0;
  double uv = 0.0, contact_m = 0.0, normal = 0.0;
};

Difference compare(const std::vector<TickOutput>& a, const std::vector<TickOutput>& b, double scale, const Vec3& move,
                   const Quat& turn) {
  REQUIRE(a.size() == b.size());
  REQUIRE(a.size() > 100);
  Difference d;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ++d.ticks;
    d.status += a[i].status != b[i].status || a[i].event != b[i].event;
    d.iterations += a[i].iterations != b[i].iterations;
    if (a[i].triangle == b[i].triangle) d.uv = std::max({d.uv, std::abs(a[i].u - b[i].u), std::abs(a[i].v - b[i].v)});
    d.contact_m = std::max(d.contact_m, glm::length(turn * a[i].contact - (b[i].contact - move) / scale));
    d.normal = std::max(d.normal, glm::length(turn * a[i].normal - b[i].normal));
  }
  return d;
}

}  // namespace

TEST_CASE("a mesh 1024 times smaller or a million times larger gives the same bits, whatever the method") {
  // Scaling by powers of two does not change rounding: any difference reveals an absolute constant.
  for (const Subject& s : subjects())
    for (const Method method : kSmoothMethods) {
      const Preset preset = base_preset(method);
      const auto metres = run(scene_of(s.mesh), preset, s.path);
      for (const double scale : {0x1p-10, 0x1p20}) {
        CAPTURE(std::string(s.name));
        CAPTURE(name_of(method));
        CAPTURE(scale);
        const auto other =
            run(scene_of(transformed(s.mesh, scale, Vec3(0.0), kNoTurn)), scaled(preset, scale), s.path, scale);
        const Difference d = compare(metres, other, scale, Vec3(0.0), kNoTurn);
        CHECK(d.status == 0);
        CHECK(d.iterations == 0);
        CHECK(d.uv == 0.0);
        CHECK(d.contact_m == 0.0);
        CHECK(d.normal == 0.0);
      }
    }
}

TEST_CASE("the same mesh in millimetres, metres and kilometres gives the same barycentrics, iterations and status") {
  // Not bitwise: 1000 is not a power of two. An error within rounding of the tolerance may take one more plane.
  for (const Subject& s : subjects())
    for (const Method method : kSmoothMethods) {
      Preset preset = base_preset(method);
      preset.solver.tolerance_m = 1e-11;
      const auto metres = run(scene_of(s.mesh), preset, s.path);
      for (const double scale : {1e-3, 1e3}) {
        CAPTURE(std::string(s.name));
        CAPTURE(name_of(method));
        CAPTURE(scale);
        const auto other =
            run(scene_of(transformed(s.mesh, scale, Vec3(0.0), kNoTurn)), scaled(preset, scale), s.path, scale);
        const Difference d = compare(metres, other, scale, Vec3(0.0), kNoTurn);
        CHECK(d.status == 0);
        CHECK(d.iterations <= d.ticks / 50);
        CHECK(d.uv <= 1e-8);
        CHECK(d.contact_m <= 1e-9);
      }
    }
}

TEST_CASE("a kilometre from the origin the contact is the same to a nanometre") {
  // Coordinates there are rounded at 1e-13 m.
  const Vec3 away(1000.0, -2000.0, 500.0);
  for (const Subject& s : subjects())
    for (const Method method : kSmoothMethods) {
      CAPTURE(std::string(s.name));
      CAPTURE(name_of(method));
      const Preset preset = base_preset(method);
      const auto here = run(scene_of(s.mesh), preset, s.path);
      const auto there = run(scene_of(transformed(s.mesh, 1.0, away, kNoTurn)), preset, s.path, 1.0, away);
      const Difference d = compare(here, there, 1.0, away, kNoTurn);
      CHECK(d.status == 0);
      CHECK(d.contact_m <= 1e-9);
    }
}

TEST_CASE("turning mesh and finger together turns the contact with them") {
  Random random(41);
  const Quat turn = random.orientation();
  for (const Subject& s : subjects())
    for (const Method method : kSmoothMethods) {
      CAPTURE(std::string(s.name));
      CAPTURE(name_of(method));
      Preset preset = base_preset(method);
      preset.solver.tolerance_m = 1e-11;
      const auto straight = run(scene_of(s.mesh), preset, s.path);
      const auto turned =
          run(scene_of(transformed(s.mesh, 1.0, Vec3(0.0), turn)), preset, s.path, 1.0, Vec3(0.0), turn);
      const Difference d = compare(straight, turned, 1.0, Vec3(0.0), turn);
      CHECK(d.contact_m <= 1e-9);
      CHECK(d.normal <= 1e-8);
      double cld = 0.0;
      for (std::size_t i = 0; i < straight.size(); ++i)
        cld = std::max(cld, std::abs(straight[i].cld_m - turned[i].cld_m));
      CHECK(cld <= 1e-9);
    }
}

TEST_CASE("the order of the triangles and of their corners changes no contact") {
  for (const Subject& s : subjects()) {
    PolygonMesh shuffled = s.mesh;
    Random random(42);
    std::vector<std::uint32_t> order(s.mesh.face_count());
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    shuffled.corner_position.clear();
    shuffled.corner_normal.clear();
    shuffled.face_offsets = {0};
    for (const std::uint32_t f : order) {
      const auto face = s.mesh.face(f);
      const std::uint32_t first = face.size() == 3 ? random.below(3) : 0;  // turning a quad would split it otherwise
      for (std::uint32_t k = 0; k < face.size(); ++k) {
        const std::size_t corner = (first + k) % face.size();
        shuffled.corner_position.push_back(face[corner]);
        if (!s.mesh.corner_normal.empty())
          shuffled.corner_normal.push_back(s.mesh.corner_normal[s.mesh.face_offsets[f] + corner]);
      }
      shuffled.face_offsets.push_back(static_cast<std::uint32_t>(shuffled.corner_position.size()));
    }
    for (const Method method : kSmoothMethods) {
      CAPTURE(std::string(s.name));
      CAPTURE(name_of(method));
      Preset preset = base_preset(method);
      preset.solver.tolerance_m = 1e-11;
      const auto a = run(scene_of(s.mesh), preset, s.path);
      const auto b = run(scene_of(shuffled), preset, s.path);
      CHECK(compare(a, b, 1.0, Vec3(0.0), kNoTurn).contact_m <= 1e-9);
    }
  }
}

TEST_CASE("the fandisk gives the same contacts in millimetres, and a kilometre away") {
  if (!testing::shared_files_there({"meshes/fandisk.obj"})) return;
  PolygonMesh mesh = *read_mesh(testing::shared_file("meshes/fandisk.obj"), 1e-3);
  mesh.normals.clear();
  mesh.corner_normal.clear();
  Box box;
  for (const Vec3& p : mesh.positions) box.include(p);
  const double fit = 0.080 / std::max({box.size().x, box.size().y, box.size().z});
  for (Vec3& p : mesh.positions) p = (p - box.centre()) * fit;
  const auto poses = path_over(mesh, 0.005, 1000);
  Preset preset = base_preset(Method::robust);
  preset.finger.radius_m = 0.005;
  const auto metres = run(scene_of(mesh), preset, poses);
  const auto large =
      run(scene_of(transformed(mesh, 0x1p10, Vec3(0.0), kNoTurn)), scaled(preset, 0x1p10), poses, 0x1p10);
  const Difference scale = compare(metres, large, 0x1p10, Vec3(0.0), kNoTurn);
  CHECK(scale.status == 0);
  CHECK(scale.iterations == 0);
  CHECK(scale.contact_m == 0.0);
  const Vec3 away(1000.0, 0.0, 0.0);
  const auto there = run(scene_of(transformed(mesh, 1.0, away, kNoTurn)), preset, poses, 1.0, away);
  CHECK(compare(metres, there, 1.0, away, kNoTurn).contact_m <= 1e-9);
}
