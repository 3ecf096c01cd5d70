// Vertex arrays of a contact mesh for the GPU: flat facets, the corner-normal stand-in, and the smooth surface
// tessellated by core's evaluator. Pure functions; called in a worker thread. Positions are local mesh coordinates
// divided by `scale_m`, so that float precision suffices for meshes of any size.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/surface/pn_patch.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <stop_token>
#include <vector>

namespace tangent {

struct FacetVertex {
  std::array<float, 3> position;
  std::uint32_t face_normal;  ///< GL_INT_2_10_10_10_REV
};

struct SurfaceVertex {
  std::array<float, 3> position;
  std::uint32_t normal;                 ///< GL_INT_2_10_10_10_REV
  std::array<std::uint8_t, 4> weights;  ///< u, v over 255, 0, 0
};

struct SurfaceMesh {
  unsigned level = 1;  ///< segments per patch edge
  std::vector<SurfaceVertex> vertices;
  std::vector<std::uint32_t> indices;
  /// Usable triangle that each drawn triangle belongs to; empty: level^2 for each, in order.
  std::vector<std::uint32_t> sources;
  std::size_t triangles() const { return indices.size() / 3; }
};

/// x, y, z in -1..1 as GL_INT_2_10_10_10_REV (normalised).
std::uint32_t packed_normal(const Vec3& normal);

/// Three vertices per usable triangle, in triangle order.
std::vector<FacetVertex> facet_vertices(const ContactMesh& mesh, double scale_m);

/// The mesh's triangles with corner normals; vertices are shared where position and normal agree.
SurfaceMesh corner_normal_mesh(const ContactMesh& mesh, double scale_m);

/// A coarse stand-in of at most about `target` triangles by vertex clustering on a grid (mean point, mean normal);
/// collapsed triangles are removed. Only for display while the camera moves.
SurfaceMesh clustered_mesh(const ContactMesh& mesh, double scale_m, std::size_t target);

/// Largest level (1..64) with at most `budget` triangles in all.
unsigned level_within(std::size_t budget, std::uint32_t patches);

/// Tessellates every usable patch into level^2 triangles: points and interpolated normals at u = i/level, v = j/level.
/// Both sides of a smooth or crease edge give the same points up to rounding, so there are no cracks. `progress` runs
/// from 0 to 1; a stop request returns an empty mesh.
SurfaceMesh tessellate(const ContactMesh& mesh, NormalForm form, unsigned level, double scale_m,
                       std::atomic<float>& progress, std::stop_token stop = {});

/// Crease and boundary edges as pairs of points, each edge once.
struct FeatureEdge {
  std::array<float, 3> a, b;
  EdgeKind kind;
};
std::vector<FeatureEdge> feature_edges(const ContactMesh& mesh, double scale_m);

}  // namespace tangent
