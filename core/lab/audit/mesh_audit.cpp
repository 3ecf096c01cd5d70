#include "core/lab/audit/mesh_audit.h"

#include "core/base/angle.h"
#include "core/base/tolerances.h"
#include "core/lab/audit/half_edges.h"
#include "core/mesh/edge_table.h"
#include "core/mesh/triangle_shape.h"
#include "core/mesh/union_find.h"
#include "core/mesh/weld.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Reorders `values`. The median of an even number of values is the upper one.
MinMedianMax min_median_max(std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  MinMedianMax r{*low, 0.0, *high};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  r.median = *middle;
  return r;
}

void name_first(std::vector<std::uint64_t>& first, std::uint64_t index) {
  if (first.size() < MeshDefectList::kNamed && (first.empty() || first.back() != index)) first.push_back(index);
}

/// Area, aspect ratio, and angles between corner normals and face normals.
void audit_triangles(const ContactMesh& mesh, MeshAudit& out) {
  std::vector<double> aspects;
  aspects.reserve(mesh.usable_triangle_count());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const auto [a, b, c] = mesh.positions(t);
    const Vec3 twice = area_vector(a, b, c);
    const double twice_area = std::sqrt(glm::dot(twice, twice));
    out.area_m2 += 0.5 * twice_area;
    // The smallest height is that over the longest side.
    const double aspect = longest_side2(a, b, c) / twice_area;
    aspects.push_back(aspect);
    if (aspect * kSliverAspect > 1.0) {
      ++out.sliver_triangles;
      name_first(out.first_slivers, t);
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double deg = angle_between_deg(mesh.normal(t, k), twice / twice_area);
      out.max_normal_to_face_deg = std::max(out.max_normal_to_face_deg, deg);
      if (deg > kWildNormalDeg) ++out.wild_normals;
      if (deg > 90.0) {
        ++out.flipped_normals;
        name_first(out.first_flipped, t);
      }
    }
  }
  out.aspect = min_median_max(aspects);
}

/// Edges of the contact mesh: lengths, dihedral angles, creases, boundaries and the loops they form.
void audit_edges(const ContactMesh& mesh, MeshAudit& out) {
  const HalfEdges half = to_half_edges(mesh);
  const HalfEdgeMesh& m = half.mesh;
  out.edges = m.n_edges();
  std::vector<double> lengths, dihedrals;
  lengths.reserve(m.n_edges());
  dihedrals.reserve(m.n_edges());
  const auto position = [&](OpenMesh::VertexHandle v) {
    return mesh.vertex_position(static_cast<std::uint32_t>(v.idx()));
  };
  const auto normal_of = [&](OpenMesh::FaceHandle f) {
    const auto [a, b, c] = mesh.positions(half.triangle_of[static_cast<std::size_t>(f.idx())]);
    return face_normal(a, b, c);
  };
  for (const auto edge : m.edges()) {
    const OpenMesh::HalfedgeHandle h = m.halfedge_handle(edge, 0);
    const Vec3 side = position(m.to_vertex_handle(h)) - position(m.from_vertex_handle(h));
    lengths.push_back(std::sqrt(glm::dot(side, side)));
    if (m.is_boundary(edge)) continue;
    dihedrals.push_back(angle_between_deg(normal_of(m.face_handle(h)), normal_of(m.opposite_face_handle(h))));
  }
  out.edge_length_m = min_median_max(lengths);
  out.dihedral_deg = min_median_max(dihedrals);

  std::vector<bool> seen(m.n_halfedges(), false);
  for (const auto start : m.halfedges()) {
    if (!m.is_boundary(start)) continue;
    ++out.boundary_edges;
    if (seen[static_cast<std::size_t>(start.idx())]) continue;
    ++out.boundary_loops;
    OpenMesh::HalfedgeHandle h = start;
    do {
      seen[static_cast<std::size_t>(h.idx())] = true;
      h = m.next_halfedge_handle(h);
    } while (h != start);
  }
  for (const std::uint32_t t : half.triangle_of)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.edge_kind(t, k) == EdgeKind::crease && mesh.across(t, k).triangle > t) ++out.crease_edges;
}

/// Edges and vertices as in the file, by position, before any triangle was detached or any vertex split.
void audit_manifold(const ContactMesh& mesh, MeshAudit& out) {
  std::vector<Vec3> positions(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) positions[v] = mesh.vertex_position(v);
  const Weld weld = weld_exact(positions, kLargestCoordinate);
  std::vector<Index3> triangles(mesh.triangles().begin(), mesh.triangles().end());
  UnionFind parts(mesh.vertex_count()), fans(mesh.vertex_count());
  std::vector<bool> in_use(mesh.vertex_count(), false);
  for (Index3& v : triangles) {
    if (v[0] == kNone) continue;
    parts.join(v[0], v[1]);
    parts.join(v[1], v[2]);
    for (std::uint32_t& i : v) {
      in_use[i] = true;
      i = weld.id[i];
    }
  }
  const EdgeTable edges(triangles, weld.count());
  edges.for_each_edge([&](std::uint32_t, std::span<const EdgeUse> uses) {
    if (uses.size() > 2) ++out.non_manifold_edges;
    if (uses.size() == 2 && uses[0].backward() == uses[1].backward()) ++out.inconsistent_edges;
    // Triangles at an edge belong to one component and, at both ends, to one fan, whatever their orientation.
    const auto end_of = [&](const EdgeUse& use, bool far) {
      return mesh.vertex(use.triangle(), far == use.backward() ? use.edge() : next3(use.edge()));
    };
    for (std::size_t i = 1; i < uses.size(); ++i) {
      for (const bool far : {false, true}) {
        parts.join(end_of(uses[i], far), end_of(uses[0], far));
        fans.join(end_of(uses[i], far), end_of(uses[0], far));
      }
    }
  });
  std::vector<std::uint32_t> fan_at(weld.count(), kNone);
  std::vector<bool> counted(weld.count(), false);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!in_use[v]) continue;
    if (parts.root(v) == v) ++out.components;
    const std::uint32_t p = weld.id[v], fan = fans.root(v);
    if (fan_at[p] == kNone) fan_at[p] = fan;
    if (fan_at[p] == fan || counted[p]) continue;
    counted[p] = true;
    ++out.non_manifold_vertices;
  }
}

}  // namespace

MeshAudit audit_mesh(const PolygonMesh& source, const ContactMesh& mesh) {
  MeshAudit out;
  out.file_vertices = source.positions.size();
  out.file_faces = source.face_count();
  out.triangles = mesh.triangle_count();
  out.usable_triangles = mesh.usable_triangle_count();
  out.vertices = mesh.vertex_count();
  out.box_min_m = mesh.origin() + mesh.bounds().min;
  out.box_max_m = mesh.origin() + mesh.bounds().max;
  audit_triangles(mesh, out);
  audit_edges(mesh, out);
  audit_manifold(mesh, out);
  return out;
}

}  // namespace tangent
