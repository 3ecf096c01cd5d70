// From triangles over shared vertices to a surface: which triangle lies across each edge, and one vertex per fan.
//
// Rules, in order. A directed edge belongs to the first triangle (lowest number) that runs along it. A later
// triangle with the same three vertices in the same turn is a duplicate and goes; any other later triangle on
// a directed edge that is taken (a third fin, or a neighbour turned the other way round) is detached: it stays,
// with vertices of its own and boundaries all round. What is left on the two directions of an edge is linked. Then
// every vertex whose triangles form several fans (a bow tie) is split into one vertex per fan.
// The result is an oriented manifold with boundary, whatever came in, and depends on file order only
// where the rules say so.
//
// Why not OpenMesh's add_face here: measured on this data (one core), it took 1.5 s for a 5.24M-triangle
// icosphere in file order but 7.3 s shuffled, and 6.9 s for a shuffled cone of 40,000 sides, growing with the square of
// the valence. By the way it walks one fan per vertex (read, not tried) it would also refuse the second fan at a vertex
// whose first is closed, and miss edges that sit in another fan. OpenMesh carries the surface once it is one:
// half_edges.h.
#pragma once

#include "core/base/run_both.h"
#include "core/base/unfilled.h"
#include "core/mesh/fan_walk.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

struct Topology {
  UnfilledVector<Index3> links;           ///< per triangle and edge: triangle << 2 | edge across, kNone at a boundary
  std::vector<std::uint32_t> copy_of;     ///< new vertex vertex_count + i stands where vertex copy_of[i] is
  std::vector<std::uint32_t> duplicates;  ///< triangles taken out, ascending
  std::vector<std::uint32_t> detached;    ///< triangles kept apart, ascending
};

/// Works on `triangles` in place: duplicates become {kNone, kNone, kNone}, split vertices get new numbers from
/// vertex_count up. Triangles whose first vertex is kNone are left out.
/// Precondition: at most kMaxTriangles; the vertices of a triangle differ and are below vertex_count.
Topology build_topology(std::span<Index3> triangles, std::uint32_t vertex_count, const RunBoth& run_both = run_in_turn);

}  // namespace tangent
