// The triangles around a vertex, walked by adjacency.
#pragma once

#include "core/mesh/contact_mesh.h"

namespace tangent {

/// Calls visit(triangle, corner) for every triangle of the fan around corner `corner` of `t`: once round, or
/// out to the boundary both ways.
template <class Visit>
void around_vertex(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner, Visit visit) {
  std::uint32_t at = t, k = corner;
  for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    visit(at, k);
    const EdgeLink next = mesh.across(at, (k + 2) % 3);  // the edge that ends at the corner
    if (next.triangle == kNone) break;
    at = next.triangle;
    k = next.edge;
    if (at == t && k == corner) return;
  }
  at = t;
  k = corner;
  for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    const EdgeLink next = mesh.across(at, k);  // the edge that starts at the corner
    if (next.triangle == kNone) return;
    at = next.triangle;
    k = (next.edge + 1) % 3;
    if (at == t && k == corner) return;
    visit(at, k);
  }
}

/// The same, but where many faces of a flat region follow each other it visits only those that matter to a vector from
/// the vertex, `direction(normal)` by the region's normal: where it points to, the next ones, and both ends of the run.
template <class Direction, class Visit>
void around_vertex_towards(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner, Direction direction,
                           Visit visit) {
  const CrowdedVertex* crowded = mesh.crowded_vertex(mesh.vertex(t, corner));
  if (!crowded) return around_vertex(mesh, t, corner, visit);
  for (const CrowdedVertex::Run& run : crowded->runs) {
    if (run.region == kNone) {
      visit(crowded->ring[run.first].triangle, crowded->ring[run.first].corner);
      continue;
    }
    std::uint32_t before = kNone;
    for (const std::uint32_t i : crowded->towards(run, direction(run.normal))) {
      if (i != before) visit(crowded->ring[i].triangle, crowded->ring[i].corner);
      before = i;
    }
  }
}

}  // namespace tangent
