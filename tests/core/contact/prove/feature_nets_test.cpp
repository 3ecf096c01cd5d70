// Parts of creases and vertices: what they bound, and that no finger with a core is kept off one that it touches.
#include "core/contact/prove/feature_nets.h"

#include "core/contact/edge_fan.h"
#include "core/contact/prove/core_crease_proof.h"
#include "core/contact/prove/core_feature_proof.h"
#include "core/mesh/vertex_ring.h"
#include "tests/core/creased_meshes.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Crease {
  std::uint32_t triangle, side;
};
std::vector<Crease> creases_of(const ContactMesh& mesh) {
  std::vector<Crease> creases;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.edge_kind(t, k) == EdgeKind::crease) creases.push_back({t, k});
  return creases;
}

Finger long_finger(Random& random) {
  Finger finger = finger_of(random.below(2) ? FingerShape::ellipsoid : FingerShape::capsule);
  finger.radius_m = random.in(0.002, 0.012);
  finger.half_length_m = random.in(0.002, 0.020);
  finger.semi_axes_m = {random.in(0.004, 0.020), random.in(0.004, 0.020), random.in(0.004, 0.020)};
  return finger;
}

/// From elsewhere, so far as gone_m counts.
FingerPose away_from(const FingerPose& pose, const Finger& finger, double way_m, Random& random) {
  const double turned = random.below(2) ? random.in(0.0, 1.0) * way_m : 0.0;
  return {pose.position + (way_m - turned) * random.direction(),
          glm::angleAxis(turned / finger.reach_m(), random.direction()) * pose.orientation};
}

}  // namespace

TEST_CASE("the fan at every place of a crease is what its part says, and within its bounds") {
  Random random(311);
  int outside = 0, off_arc = 0, off_turn = 0, looked_at = 0;
  double most_off = 0.0;
  for (const ContactMesh& mesh : creased_meshes()) {
    PatchCache cache(mesh);
    const std::vector<Crease> creases = creases_of(mesh);
    REQUIRE(!creases.empty());
    for (int i = 0; i < rounds(2000); ++i) {
      const Crease at = creases[random.below(static_cast<std::uint32_t>(creases.size()))];
      const CreaseNet part = crease_net(cache, NormalForm::bernstein, at.triangle, at.side);
      const double f = random.in(0.0, 1.0);
      const EdgeFan& fan = cache.fan(at.triangle, at.side, f, NormalForm::bernstein);
      if (!fan.convex()) continue;
      const double angle = random.in(0.0, 1.0) * std::atan2(fan.far.y, fan.far.x);
      SurfaceSample s;
      edge_sample(fan, Vec2(std::cos(angle), std::sin(angle)), s);
      const Vec3 d = glm::abs(s.point - part.box().centre()) - 0.5 * part.box().size();
      outside += std::max({d.x, d.y, d.z}) > 1e-12;
      outside += glm::dot(s.normal, part.cone().axis) < part.cone().cos_half - 1e-9;
      ++looked_at;
      // From it to another one about the edge, but for how differently they lean.
      SurfaceSample other;
      const double to = random.in(0.0, 1.0) * std::atan2(fan.far.y, fan.far.x);
      edge_sample(fan, Vec2(std::cos(to), std::sin(to)), other);
      const double cosine = glm::dot(s.normal, other.normal);
      if (cosine > 0.1 && cosine < 1.0 - 1e-6) {
        const Vec3 way = unit(other.normal - cosine * s.normal);
        const Vec3 turn = (to > angle ? 1.0 : -1.0) * unit(glm::cross(fan.tangent, s.normal));
        off_turn += glm::distance(way, turn) > part.lean_turn + 1e-6;
        most_off = std::max(most_off, glm::distance(way, turn));
      }
      // In the plane of the two normals there, but for the lean.
      const Vec3 across = glm::cross(fan.near_normal, fan.far_normal);
      off_arc += std::abs(std::asin(glm::dot(s.normal, across) / glm::length(across))) > part.lean_rad + 1e-9;
    }
  }
  CHECK(looked_at > 0);
  CHECK(outside == 0);
  CHECK(off_arc == 0);
  CHECK(off_turn == 0);
  CHECK(most_off > 1e-3);  // or nothing was tried
}

TEST_CASE("no finger with a core is kept off a crease that it touches or can come to touch within the margin") {
  Random random(312);
  int missed = 0, told = 0, all = 0;
  double nearest = 0.0;
  for (const ContactMesh& mesh : creased_meshes()) {
    PatchCache cache(mesh);
    const std::vector<Crease> creases = creases_of(mesh);
    for (int i = 0; i < rounds(20000); ++i) {
      const Crease at = creases[random.below(static_cast<std::uint32_t>(creases.size()))];
      const CreaseNet part = crease_net(cache, NormalForm::bernstein, at.triangle, at.side);
      const EdgeFan& fan = cache.fan(at.triangle, at.side, random.in(0.0, 1.0), NormalForm::bernstein);
      if (!fan.convex()) continue;
      const double angle = random.in(0.0, 1.0) * std::atan2(fan.far.y, fan.far.x);
      SurfaceSample s;
      edge_sample(fan, Vec2(std::cos(angle), std::sin(angle)), s);
      const Finger finger = long_finger(random);
      const FingerPose there = resting_on(finger, s.point, s.normal, random.in(-0.003, 0.004), random);
      const double way = std::pow(10.0, random.in(-4.0, -1.5)), enough = random.below(2) ? 0.0 : 1.0;
      const FingerCore core(finger, away_from(there, finger, way, random));
      int tests = 0;
      const double margin = crease_margin(core, part, enough, random.below(4) == 0, tests);
      missed += margin > way * (1.0 + 1e-9) + 1e-12;
      told += margin > 0.0;
      if (margin > 0.0) nearest = std::max(nearest, margin / way);
      ++all;
      CHECK(tests <= 40);
    }
  }
  CAPTURE(told);
  CAPTURE(all);
  CHECK(missed == 0);
  CHECK(told > all / 20);
  CHECK(nearest > 0.5);  // and does not fall far short
}

TEST_CASE("no finger with a core is kept off a vertex that it touches or can come to touch within the margin") {
  Random random(313);
  int missed = 0, told = 0, all = 0, arcs = 0;
  const SolverSettings settings;
  for (const ContactMesh& mesh : creased_meshes()) {
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(5000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count()), k = random.below(3);
      if (!mesh.feature_corner(t, k)) continue;
      const std::optional<VertexNormals> normals = VertexNormals::around(mesh, t, k);
      REQUIRE(normals);
      Vec3 sum(0.0);
      around_vertex(mesh, t, k, [&](std::uint32_t at, std::uint32_t corner) {
        sum += std::pow(random.in(0.0, 1.0), 4.0) * mesh.normal(at, corner);
      });
      const Vec3 normal = unit(sum);
      const Finger finger = long_finger(random);
      const FingerPose there = resting_on(finger, mesh.position(t, k), normal, random.in(-0.003, 0.004), random);
      const double way = std::pow(10.0, random.in(-4.0, -1.5));
      const FingerPose pose = away_from(there, finger, way, random);
      const FingerCore core(finger, pose);
      ContactContext context{cache, settings, finger, pose, Vec3(0.0)};
      context.core = &core;
      const double margin =
          exclude_feature_by_core(context, core, {t, k, true}, {finger.reach_m() + 0.02, 1.0}, 1e-3).margin_m;
      missed += margin > way * (1.0 + 1e-9) + 1e-12;
      told += margin > 0.0;
      ++all;
      if (const std::optional<CreaseNet> arc = normals->arc()) {
        ++arcs;
        int tests = 0;
        missed += crease_margin(core, *arc, 0.0, false, tests) > way * (1.0 + 1e-9) + 1e-12;
      }
    }
  }
  CAPTURE(told);
  CAPTURE(all);
  CHECK(missed == 0);
  CHECK(told > all / 20);
  CHECK(arcs > 0);
}

TEST_CASE("the triangles of a corner's normals hold every sum of them, and so do their halves") {
  Random random(314);
  int uncovered = 0, corners = 0;
  for (const ContactMesh& mesh : creased_meshes())
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::optional<VertexNormals> normals = VertexNormals::around(mesh, t, k);
        REQUIRE(normals);
        std::array<NormalTriangle, VertexNormals::kMost> parts;
        const std::size_t count = normals->parts(parts);
        if (count == 0) continue;
        ++corners;
        for (int i = 0; i < rounds(20); ++i) {
          Vec3 sum(0.0);
          around_vertex(mesh, t, k, [&](std::uint32_t at, std::uint32_t corner) {
            sum += std::pow(random.in(0.0, 1.0), 4.0) * mesh.normal(at, corner);
          });
          const auto holds = [&](const NormalTriangle& part) {
            const NormalCone cone = part.bounds().normals;
            return glm::dot(unit(sum), cone.axis) >= cone.cos_half - 1e-9;
          };
          bool covered = false;
          for (const NormalTriangle& part : std::span(parts).first(count)) {
            const auto halves = part.halves();
            covered = covered || (holds(part) && (holds(halves[0]) || holds(halves[1])));
          }
          uncovered += !covered;
        }
      }
  CHECK(corners > 0);
  CHECK(uncovered == 0);
}
