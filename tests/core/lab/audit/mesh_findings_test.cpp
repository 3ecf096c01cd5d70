#include "core/lab/audit/mesh_findings.h"

#include "core/base/tolerances.h"
#include "core/lab/audit/mesh_audit.h"
#include "core/lab/objects/generate.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Found {
  PolygonMesh source;
  ContactMesh mesh;
  MeshFindings findings;
};

Found find(PolygonMesh source, const ContactMeshOptions& options = {}) {
  auto mesh = ContactMesh::build(source, options);
  REQUIRE(mesh.has_value());
  MeshFindings findings = find_defects(source, *mesh);
  return {std::move(source), std::move(*mesh), std::move(findings)};
}

std::uint64_t all(const MeshFindings& findings) {
  std::uint64_t sum = 0;
  for (const std::uint64_t n : findings.found) sum += n;
  return sum;
}

}  // namespace

TEST_CASE("a sound body has no findings") { CHECK(all(find(sample::cube()).findings) == 0); }

TEST_CASE("an open sheet has one loop, at its middle, of its length, with the triangles along it") {
  const Found f = find(sample::grid(4, [](double, double) { return 0.0; }));
  REQUIRE(f.findings.count(FindingKind::boundary_loop) == 1);
  const MeshFinding& loop = f.findings.of(FindingKind::boundary_loop)[0];
  CHECK(loop.size == approx(16.0));
  CHECK(glm::length(loop.place) < 1e-12);
  CHECK(std::abs(loop.normal.z) == approx(1.0));
  for (const std::uint32_t t : loop.triangles) {
    bool at_boundary = false;
    for (std::uint32_t e = 0; e < 3; ++e) at_boundary |= f.mesh.edge_kind(t, e) == EdgeKind::boundary;
    CHECK(at_boundary);
  }
}

TEST_CASE("the findings are as many as the audit counts, on every hard mesh") {
  for (const std::string name : {"fin_on_plate", "mixed_orientation", "flipped_normals", "needle_arch",
                                 "duplicate_faces", "degenerate_faces", "open_bowl", "triangle_soup"}) {
    CAPTURE(name);
    auto source = generate_mesh(name);
    REQUIRE(source.has_value());
    const Found f = find(*source);
    const MeshAudit audit = audit_mesh(f.source, f.mesh);
    CHECK(f.findings.count(FindingKind::boundary_loop) == audit.boundary_loops);
    CHECK(f.findings.count(FindingKind::non_manifold_edge) == audit.non_manifold_edges);
    CHECK(f.findings.count(FindingKind::inconsistent_edge) == audit.inconsistent_edges);
    CHECK(f.findings.count(FindingKind::sliver) == audit.sliver_triangles);
    CHECK((f.findings.count(FindingKind::flipped_normal) > 0) == (audit.flipped_normals > 0));
    CHECK(f.findings.count(FindingKind::degenerate) == f.mesh.defects(MeshDefect::degenerate_triangle).count);
    CHECK(f.findings.count(FindingKind::duplicate) == f.mesh.defects(MeshDefect::duplicate_triangle).count);
    for (const auto& list : f.findings.listed) {
      CHECK(std::is_sorted(list.begin(), list.end(),
                           [](const MeshFinding& a, const MeshFinding& b) { return a.size > b.size; }));
      for (const MeshFinding& finding : list) {
        CHECK_FALSE(finding.triangles.empty());
        CHECK(is_finite(finding.place));
        CHECK(glm::length(finding.normal) == approx(1.0));
      }
    }
  }
}

TEST_CASE("a skipped triangle's place is found in the source, moved and scaled as the mesh is") {
  PolygonMesh source = sample::moved(sample::cube(), 1.0, {10.0, 20.0, 30.0});
  source.add_face({1, 1, 3});
  ContactMeshOptions options;
  options.fit_m = 0.1;
  const Found f = find(source, options);
  REQUIRE(f.findings.count(FindingKind::degenerate) == 1);
  const MeshFinding& skipped = f.findings.of(FindingKind::degenerate)[0];
  CHECK(skipped.triangles == std::vector<std::uint32_t>{12});
  // Corners 1, 1 and 3 of a cube of edge 2, fitted to 0.1 m.
  CHECK(glm::length(skipped.place - Vec3(0.05, -0.05 / 3.0, -0.05)) < 1e-12);
}

TEST_CASE("the worst slivers are listed, the others counted") {
  PolygonMesh m;
  m.name = "needles";
  for (int i = 0; i < 500; ++i) {
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    const double thin = 1e-3 / (1.0 + i);
    m.positions.insert(m.positions.end(), {Vec3(0, 2.0 * i, 0), Vec3(1, 2.0 * i, 0), Vec3(0.5, 2.0 * i + thin, 0)});
    m.add_face({base, base + 1, base + 2});
  }
  const Found f = find(m);
  CHECK(f.findings.count(FindingKind::sliver) == 500);
  REQUIRE(f.findings.of(FindingKind::sliver).size() == MeshFindings::kMostListed);
  CHECK(f.findings.of(FindingKind::sliver)[0].triangles == std::vector<std::uint32_t>{499});
  CHECK(f.findings.of(FindingKind::sliver).back().triangles == std::vector<std::uint32_t>{400});
}
