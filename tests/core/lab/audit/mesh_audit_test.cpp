#include "core/lab/audit/mesh_audit.h"

#include "core/lab/audit/half_edges.h"
#include "core/lab/objects/generate.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

MeshAudit audit(const PolygonMesh& source, const ContactMeshOptions& options = {}) {
  const auto mesh = ContactMesh::build(source, options);
  if (!mesh) FAIL(mesh.error().message());
  return audit_mesh(source, *mesh);
}

}  // namespace

TEST_CASE("audit of a cube: every figure known") {
  const MeshAudit a = audit(sample::moved(sample::unwelded(sample::cube()), 1.0, Vec3(1, 2, 3)));
  CHECK(a.file_vertices == 24);
  CHECK(a.file_faces == 6);
  CHECK(a.triangles == 12);
  CHECK(a.usable_triangles == 12);
  CHECK(a.vertices == 8);
  CHECK(a.edges == 18);
  CHECK(a.box_min_m == Vec3(0, 1, 2));
  CHECK(a.box_max_m == Vec3(2, 3, 4));
  CHECK(a.area_m2 == approx(24.0).epsilon(1e-14));
  CHECK(a.components == 1);
  CHECK(a.boundary_edges == 0);
  CHECK(a.boundary_loops == 0);
  CHECK(a.non_manifold_edges == 0);
  CHECK(a.non_manifold_vertices == 0);
  CHECK(a.inconsistent_edges == 0);
  CHECK(a.crease_edges == 12);
  CHECK(a.sliver_triangles == 0);
  CHECK(a.flipped_normals == 0);
  CHECK(a.wild_normals == 0);
  CHECK(a.max_normal_to_face_deg == 0.0);
  CHECK(a.edge_length_m.min == 2.0);
  CHECK(a.edge_length_m.median == 2.0);
  CHECK(a.edge_length_m.max == approx(std::sqrt(8.0)));
  CHECK(a.dihedral_deg.min == 0.0);
  CHECK(a.dihedral_deg.median == approx(90.0));
  CHECK(a.dihedral_deg.max == approx(90.0));
  CHECK(a.aspect.min == approx(2.0));
  CHECK(a.aspect.max == approx(2.0));
}

TEST_CASE("audit counts boundary loops and parts") {
  // Two grids side by side, one with a hole in the middle.
  PolygonMesh a = sample::grid(3, [](double, double) { return 0.0; });
  a.corner_position.erase(a.corner_position.begin() + 24, a.corner_position.begin() + 30);
  a.face_offsets.resize(a.face_offsets.size() - 2);
  const auto shift = static_cast<std::uint32_t>(a.positions.size());
  const PolygonMesh b = sample::moved(sample::grid(2, [](double, double) { return 0.0; }), 1.0, Vec3(10, 0, 0));
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (std::size_t f = 0; f < b.face_count(); ++f)
    a.add_face({b.face(f)[0] + shift, b.face(f)[1] + shift, b.face(f)[2] + shift});
  const MeshAudit r = audit(a);
  CHECK(r.components == 2);
  CHECK(r.boundary_loops == 3);
  CHECK(r.boundary_edges == 12 + 4 + 8);
  CHECK(r.dihedral_deg.max == 0.0);
}

TEST_CASE("audit tells three fins, bow ties and wrong turns apart") {
  const MeshAudit fins =
      audit(sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  CHECK(fins.non_manifold_edges == 1);
  CHECK(fins.non_manifold_vertices == 0);
  CHECK(fins.inconsistent_edges == 0);
  CHECK(fins.components == 1);
  CHECK(fins.boundary_edges == 4 + 3);
  CHECK(fins.boundary_loops == 2);

  const MeshAudit tie =
      audit(sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  CHECK(tie.non_manifold_edges == 0);
  CHECK(tie.non_manifold_vertices == 1);
  CHECK(tie.components == 2);
  CHECK(tie.boundary_loops == 2);

  const MeshAudit turned = audit(sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}}));
  CHECK(turned.inconsistent_edges == 1);
  CHECK(turned.non_manifold_edges == 0);
  CHECK(turned.non_manifold_vertices == 0);
  CHECK(turned.components == 1);

  const MeshAudit strip = audit(sample::moebius(20));
  CHECK(strip.inconsistent_edges == 1);
  CHECK(strip.components == 1);
}

TEST_CASE("audit lists slivers and normals against their faces") {
  auto source = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -0.005, 0}}, {{0, 1, 2}, {1, 0, 3}});
  source.normals = {{0, 0, 1}, {0, 0, -1}, {0, 2, 1}};
  source.corner_normal = {0, 1, 2, 0, 0, 0};
  const MeshAudit a = audit(source);
  CHECK(a.sliver_triangles == 1);
  CHECK(a.first_slivers == std::vector<std::uint64_t>{1});
  CHECK(a.aspect.max == approx(200.0));
  CHECK(a.flipped_normals == 1);
  CHECK(a.first_flipped == std::vector<std::uint64_t>{0});
  CHECK(a.wild_normals == 2);
  CHECK(a.max_normal_to_face_deg == 180.0);
}

TEST_CASE("half-edges of a sphere satisfy Euler and are all reachable") {
  const PolygonMesh sphere = make_icosphere(0.04, 3);
  const auto mesh = ContactMesh::build(sphere);
  REQUIRE(mesh);
  const HalfEdges half = to_half_edges(*mesh);
  CHECK(half.mesh.n_vertices() + half.mesh.n_faces() - half.mesh.n_edges() == 2);
  for (const auto v : half.mesh.vertices()) CHECK((half.mesh.valence(v) == 5 || half.mesh.valence(v) == 6));
}

TEST_CASE("half-edge structure is closed under next, opposite and turning on random soups") {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const PolygonMesh source = sample::soup(seed, 8 + static_cast<int>(seed % 40), 10 + static_cast<int>(seed % 90));
    const auto mesh = ContactMesh::build(source);
    if (!mesh) continue;
    const HalfEdges half = to_half_edges(*mesh);
    const HalfEdgeMesh& m = half.mesh;
    REQUIRE(m.n_faces() == mesh->usable_triangle_count());
    std::size_t wrong = 0, around = 0, used = 0;
    for (const auto h : m.halfedges()) {
      const auto next = m.next_halfedge_handle(h);
      wrong += !next.is_valid() || m.to_vertex_handle(h) != m.from_vertex_handle(next) ||
               m.face_handle(h) != m.face_handle(next);
    }
    for (const auto f : m.faces()) {
      std::uint32_t k = 0;
      for (const auto h : m.fh_range(f)) {
        wrong += static_cast<std::uint32_t>(m.from_vertex_handle(h).idx()) !=
                 mesh->vertex(half.triangle_of[static_cast<std::size_t>(f.idx())], k++);
        ++used;
      }
      wrong += k != 3;
    }
    for (const auto v : m.vertices())
      for ([[maybe_unused]] const auto f : m.vf_range(v)) ++around;
    CHECK(wrong == 0);
    CHECK(around == used);  // each corner is met by turning about its vertex
    const MeshAudit a = audit_mesh(source, *mesh);
    CHECK(a.boundary_loops <= a.boundary_edges);
    CHECK(std::isfinite(a.aspect.max));
  }
}
