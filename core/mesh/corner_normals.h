// Corner normals of a surface and the creases they make.
//
// A corner's computed normal is the mean of the face normals around its vertex, each weighted by its angle there
// (Thurmer & Wuthrich 1998), over the connected fan of faces that is left when crease and boundary edges are taken
// away. A single crease edge at a vertex leaves one fan, so it doesn't split the vertex: creases can end
// inside the surface.
#pragma once

#include "core/base/run_both.h"
#include "core/base/unfilled.h"
#include "core/base/vec.h"
#include "core/mesh/fan_walk.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

/// Views of a surface whose vertices have one fan each (build_topology). Positions are relative to its centre.
struct SurfaceView {
  std::span<const Vec3> positions;
  std::span<const Index3> triangles;  ///< first vertex kNone: not used
  std::span<const Index3> links;      ///< triangle << 2 | edge, kNone at a boundary
  bool used(std::uint32_t t) const { return triangles[t][0] != kNone; }
  const Vec3& position(Corner c) const { return positions[triangles[c.triangle][c.corner]]; }
};

/// Unit normals and which of them each corner has; kNone for triangles that are not used.
struct CornerNormals {
  UnfilledVector<Vec3> normals;
  UnfilledVector<Index3> index;
};

/// The same, owned by someone else.
struct CornerNormalsView {
  std::span<const Vec3> normals;
  std::span<const Index3> index;
};

/// Unit face normals; zero for triangles that are not used.
Unfilled<Vec3> face_normals(const SurfaceView& surface, const RunBoth& run_both = run_in_turn);

/// Per triangle, bit k: the dihedral angle at edge k exceeds crease_rad (by more than kCreaseSlack).
/// Angles from 0 (flat) to pi (folded back).
std::vector<std::uint8_t> sharp_edges(const SurfaceView& surface, std::span<const Vec3> faces, double crease_rad,
                                      const RunBoth& run_both = run_in_turn);

/// Computed normals; where they cancel (a thin fin) each corner gets its face normal. Always unit.
CornerNormals computed_normals(const SurfaceView& surface, std::span<const Vec3> faces,
                               std::span<const std::uint8_t> sharp, const RunBoth& run_both = run_in_turn);

/// Per triangle, bit k: corner normals differ across edge k at either end (by more than kSameNormal): a crease.
/// Bit 3 + k: a crease or boundary edge ends at corner k's vertex.
std::vector<std::uint8_t> feature_bits(const SurfaceView& surface, const CornerNormalsView& normals,
                                       const RunBoth& run_both = run_in_turn);

}  // namespace tangent
