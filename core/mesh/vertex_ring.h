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

}  // namespace tangent
