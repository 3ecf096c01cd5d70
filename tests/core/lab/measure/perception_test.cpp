#include "core/lab/measure/perception.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <algorithm>

using namespace tangent;
using namespace tangent::test;

namespace {

ContactMesh mesh_of(const PolygonMesh& source) {
  auto mesh = ContactMesh::build(source);
  REQUIRE(mesh.has_value());
  return std::move(*mesh);
}
PerceptionAudit audit_of(const ContactMesh& mesh) { return audit_perception(mesh, facet_angles(mesh)); }

const ConditionFeel& feel(const PerceptionAudit& audit, const char* name) {
  return audit.conditions[static_cast<std::size_t>(threshold_index(name))];
}

/// A cylinder's wall of `around` facets, `length` long, open: every edge along it turns by 360/around degrees.
PolygonMesh wall(int around) {
  PolygonMesh mesh;
  mesh.name = "wall";
  for (int i = 0; i < around; ++i) {
    const double a = 2.0 * 3.14159265358979323846 * i / around;
    for (const double z : {0.0, 0.05}) mesh.positions.emplace_back(0.04 * std::cos(a), 0.04 * std::sin(a), z);
  }
  for (int i = 0; i < around; ++i) {
    const auto a = static_cast<std::uint32_t>(2 * i), b = static_cast<std::uint32_t>(2 * ((i + 1) % around));
    mesh.add_face({a, b, b + 1, a + 1});
  }
  return mesh;
}

}  // namespace

TEST_CASE("a cylinder of 36 facets: 10 degrees at each, diagonals flat, ends boundary") {
  const PerceptionAudit audit = audit_of(mesh_of(wall(36)));
  CHECK(audit.curve_edges == 36);
  CHECK(audit.flat_edges == 36);
  CHECK(audit.boundary_edges == 72);
  CHECK(audit.crease_edges == 0);
  CHECK(audit.largest_curve_deg == approx(10.0).epsilon(1e-6));
  for (const char* name : {"C1", "C2", "C3", "C4", "P2"}) {
    CHECK(feel(audit, name).felt == 36);
    CHECK(feel(audit, name).felt_length_m == approx(36 * 0.05));
    CHECK(feel(audit, name).worst.size() == kWorstEdges);
  }
  CHECK(feel(audit, "P1").felt == 0);
  CHECK(feel(audit, "P1").worst.empty());
  CHECK(verdict(audit, threshold_index("C3")) ==
        "under C3 all edges are above 0.2 deg: facets will be felt; with force and tactile shading (P1, pilot data) "
        "none are above 14.8 deg");
}

TEST_CASE("within the interval an edge is doubtful, above the mean it is felt") {
  const PerceptionAudit audit =
      audit_of(mesh_of(wall(100)));  // 3.6 degrees: C4 is 3.5 [2.84, 4.59], C2 3.4 [3.05, 3.84]
  CHECK(feel(audit, "C4").felt == 100);
  CHECK(feel(audit, "C4").doubtful == 100);
  CHECK(feel(audit, "C4").surely_felt == 0);
  const PerceptionAudit finer = audit_of(mesh_of(wall(110)));  // 3.27
  CHECK(feel(finer, "C2").felt == 0);
  CHECK(feel(finer, "C2").doubtful == 110);
  CHECK(verdict(finer, threshold_index("C2")) ==
        "under C2 none are above 3.4 deg, but some within the threshold's interval: it may feel smooth; with force and "
        "tactile "
        "shading (P1, pilot data) none are above 14.8 deg");
}

TEST_CASE("a cube's edges are creases and its diagonals flat: nothing for shading to smooth") {
  const PerceptionAudit audit = audit_of(mesh_of(*generate_mesh("cube")));
  CHECK(audit.curve_edges == 0);
  CHECK(audit.crease_edges >= 12);
  CHECK(audit.flat_edges > 0);
  CHECK(verdict(audit, 0) == "no edge lies between facets of a curve: there is nothing that shading would smooth");
}

TEST_CASE("a rounded cube: its flat faces stay flat, its fillets are curves, and the counts add up to all edges") {
  const ContactMesh mesh = mesh_of(*generate_mesh("cube", {.rounding_m = 1.5e-3}));
  const PerceptionAudit audit = audit_of(mesh);
  CHECK(audit.flat_edges > 0);
  CHECK(audit.curve_edges > 0);
  CHECK(audit.crease_edges == 0);
  CHECK(audit.curve_edges + audit.flat_edges == 3 * static_cast<std::uint64_t>(mesh.usable_triangle_count()) / 2);
}

TEST_CASE("the heat map is the largest angle over the threshold, zero on flat faces and at creases") {
  const ContactMesh mesh = mesh_of(wall(36));
  const std::vector<float> ratio = felt_ratio(facet_angles(mesh), kPerceptionThresholds[0]);
  for (const float r : ratio) CHECK(r == approx(20.0).epsilon(1e-5));
  CHECK(largest_curve_angle_rad(mesh, 5) == approx(10.0 * kDegree));
  const ContactMesh cube = mesh_of(*generate_mesh("cube"));
  CHECK(largest_curve_angle_rad(cube, 0) == 0.0);
  for (const float r : felt_ratio(facet_angles(cube), kPerceptionThresholds[0])) CHECK(r == 0.0f);
}
