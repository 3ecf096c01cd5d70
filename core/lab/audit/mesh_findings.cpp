#include "core/lab/audit/mesh_findings.h"

#include "core/base/angle.h"
#include "core/base/tolerances.h"
#include "core/lab/audit/half_edges.h"
#include "core/mesh/edge_table.h"
#include "core/mesh/triangle_shape.h"
#include "core/mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace tangent {
namespace {

constexpr std::array<std::string_view, kFindingKindCount> kLabels{
    "Boundary loops", "Non-manifold edges", "Inconsistent edges", "Flipped normals", "Wild normals",
    "Slivers",        "Degenerate",         "Duplicates"};

Vec3 normal_or_up(const Vec3& a, const Vec3& b, const Vec3& c) {
  return is_degenerate(a, b, c) ? Vec3(0.0, 0.0, 1.0) : face_normal(a, b, c);
}

/// Keeps the largest findings of each kind, and counts all.
class Collector {
 public:
  explicit Collector(MeshFindings& out) : out_(out) {}
  template <class Make>
  void add(FindingKind kind, double size, Make make) {
    const auto k = static_cast<std::size_t>(kind);
    ++out_.found[k];
    auto& list = out_.listed[k];
    if (list.size() >= 2 * MeshFindings::kMostListed) {
      trim(list);
      if (size <= list.back().size) return;
    }
    MeshFinding finding = make();
    finding.kind = kind;
    finding.size = size;
    list.push_back(std::move(finding));
  }
  void finish() {
    for (auto& list : out_.listed) trim(list);
  }

 private:
  static void trim(std::vector<MeshFinding>& list) {
    std::stable_sort(list.begin(), list.end(),
                     [](const MeshFinding& a, const MeshFinding& b) { return a.size > b.size; });
    if (list.size() > MeshFindings::kMostListed) list.resize(MeshFindings::kMostListed);
  }
  MeshFindings& out_;
};

MeshFinding at_triangle(const ContactMesh& mesh, std::uint32_t t) {
  const auto [a, b, c] = mesh.positions(t);
  MeshFinding f;
  f.triangles = {t};
  f.place = (a + b + c) / 3.0;
  f.normal = normal_or_up(a, b, c);
  f.extent_m = std::sqrt(longest_side2(a, b, c));
  return f;
}

void find_bad_triangles(const ContactMesh& mesh, Collector& found) {
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const auto [a, b, c] = mesh.positions(t);
    const Vec3 twice = area_vector(a, b, c);
    const double twice_area = std::sqrt(glm::dot(twice, twice));
    const double aspect = longest_side2(a, b, c) / twice_area;
    if (aspect * kSliverAspect > 1.0) found.add(FindingKind::sliver, aspect, [&] { return at_triangle(mesh, t); });
    double widest = 0.0;
    for (std::uint32_t k = 0; k < 3; ++k)
      widest = std::max(widest, angle_between_deg(mesh.normal(t, k), twice / twice_area));
    if (widest > 90.0)
      found.add(FindingKind::flipped_normal, widest, [&] { return at_triangle(mesh, t); });
    else if (widest > kWildNormalDeg)
      found.add(FindingKind::wild_normal, widest, [&] { return at_triangle(mesh, t); });
  }
}

/// Holes and rims, traversed along their boundary half-edges.
void find_loops(const ContactMesh& mesh, Collector& found) {
  bool any = false;
  for (std::uint32_t t = 0; t < mesh.triangle_count() && !any; ++t) {
    for (std::uint32_t e = 0; mesh.usable(t) && e < 3; ++e) any |= mesh.edge_kind(t, e) == EdgeKind::boundary;
  }
  if (!any) return;
  const HalfEdges half = to_half_edges(mesh);
  const HalfEdgeMesh& m = half.mesh;
  std::vector<bool> seen(m.n_halfedges(), false);
  for (const auto start : m.halfedges()) {
    if (!m.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())]) continue;
    double length = 0.0;
    Box box;
    Vec3 normal(0.0);
    std::vector<std::uint32_t> triangles;
    OpenMesh::HalfedgeHandle h = start;
    do {
      seen[static_cast<std::size_t>(h.idx())] = true;
      const Vec3& from = mesh.vertex_position(static_cast<std::uint32_t>(m.from_vertex_handle(h).idx()));
      const Vec3& to = mesh.vertex_position(static_cast<std::uint32_t>(m.to_vertex_handle(h).idx()));
      length += glm::length(to - from);
      box.include(from);
      const std::uint32_t t =
          half.triangle_of[static_cast<std::size_t>(m.face_handle(m.opposite_halfedge_handle(h)).idx())];
      const auto [a, b, c] = mesh.positions(t);
      normal += area_vector(a, b, c);
      if (triangles.size() < MeshFindings::kMostTriangles) triangles.push_back(t);
      h = m.next_halfedge_handle(h);
    } while (h != start);
    found.add(FindingKind::boundary_loop, length, [&] {
      MeshFinding f;
      std::sort(triangles.begin(), triangles.end());
      triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
      f.triangles = std::move(triangles);
      f.place = box.centre();
      f.extent_m = glm::length(box.size());
      f.normal = glm::dot(normal, normal) > 0.0 ? unit(normal) : Vec3(0.0, 0.0, 1.0);
      return f;
    });
  }
}

/// As in the file, by position, before any triangle was detached.
void find_bad_edges(const ContactMesh& mesh, Collector& found) {
  std::vector<Vec3> positions(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) positions[v] = mesh.vertex_position(v);
  const Weld weld = weld_exact(positions, kLargestCoordinate);
  std::vector<Index3> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (Index3& v : triangles) {
    for (std::uint32_t& i : v) {
      if (i != kNone) i = weld.id[i];
    }
  }
  const EdgeTable edges(triangles, weld.count());
  edges.for_each_edge([&](std::uint32_t low, std::span<const EdgeUse> uses) {
    const bool crowded = uses.size() > 2, turned = uses.size() == 2 && uses[0].backward() == uses[1].backward();
    if (!crowded && !turned) return;
    const Vec3& a = positions[weld.first[low]];
    const Vec3& b = positions[weld.first[uses[0].far_vertex()]];
    const double length = glm::length(b - a);
    found.add(crowded ? FindingKind::non_manifold_edge : FindingKind::inconsistent_edge,
              crowded ? static_cast<double>(uses.size()) : length, [&] {
                MeshFinding f = at_triangle(mesh, uses[0].triangle());
                f.triangles.clear();
                for (const EdgeUse& use : uses) f.triangles.push_back(use.triangle());
                std::sort(f.triangles.begin(), f.triangles.end());
                f.place = 0.5 * (a + b);
                f.extent_m = std::max(f.extent_m, length);
                return f;
              });
  });
}

/// Corners of triangles that were skipped, which exist only in the source. Converts them to local coordinates.
class SourcePlaces {
 public:
  SourcePlaces(const PolygonMesh& source, const ContactMesh& mesh) : source_(source), scale_(mesh.scale_applied()) {
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!mesh.usable(t)) continue;
      offset_ = corners(t)[0] - mesh.position(t, 0) / scale_;
      return;
    }
  }
  std::array<Vec3, 3> local(std::uint32_t t) const {
    auto p = corners(t);
    for (Vec3& x : p) x = (x - offset_) * scale_;
    return p;
  }

 private:
  /// Counts the fans (0, k-1, k) of all faces up to t: slow, but called only a few times.
  std::array<Vec3, 3> corners(std::uint32_t t) const {
    std::uint64_t left = t;
    for (std::size_t f = 0; f < source_.face_count(); ++f) {
      const auto face = source_.face(f);
      const std::uint64_t fans = face.size() >= 3 ? face.size() - 2 : 0;
      if (left < fans)
        return {source_.positions[face[0]], source_.positions[face[left + 1]], source_.positions[face[left + 2]]};
      left -= fans;
    }
    return {};
  }
  const PolygonMesh& source_;
  double scale_;
  Vec3 offset_{0.0};
};

void name_skipped(const PolygonMesh& source, const ContactMesh& mesh, MeshFindings& out) {
  std::optional<SourcePlaces> places;
  for (const auto& [defect, kind] : {std::pair(MeshDefect::degenerate_triangle, FindingKind::degenerate),
                                     std::pair(MeshDefect::duplicate_triangle, FindingKind::duplicate)}) {
    const MeshDefectList& list = mesh.defects(defect);
    out.found[static_cast<std::size_t>(kind)] = list.count;
    for (const std::uint64_t index : list.first) {
      if (!places) places.emplace(source, mesh);
      const auto t = static_cast<std::uint32_t>(index);
      const auto [a, b, c] = places->local(t);
      MeshFinding f;
      f.kind = kind;
      f.triangles = {t};
      f.place = (a + b + c) / 3.0;
      f.normal = normal_or_up(a, b, c);
      f.extent_m = std::sqrt(longest_side2(a, b, c));
      if (is_finite(f.place)) out.listed[static_cast<std::size_t>(kind)].push_back(std::move(f));
    }
  }
}

}  // namespace

std::string_view label_of(FindingKind kind) { return kLabels[static_cast<std::size_t>(kind)]; }

MeshFindings find_defects(const PolygonMesh& source, const ContactMesh& mesh) {
  MeshFindings out;
  Collector found(out);
  find_bad_triangles(mesh, found);
  find_loops(mesh, found);
  find_bad_edges(mesh, found);
  found.finish();
  name_skipped(source, mesh, out);
  return out;
}

}  // namespace tangent
