// Vertices on which a contact can rest and where many slivers of a flat region meet, as all of a cap's do that is a fan
// about one of its corners. What is asked of the faces around such a vertex depends, over a region, on where the
// finger's foot lies: on one sliver and its neighbours (vertex_ring.h: around_vertex_towards).
#pragma once

#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tangent {

class ContactMesh;

struct CornerOfTriangle {
  std::uint32_t triangle = kNone, corner = 0;
};

struct CrowdedVertex {
  /// Faces that follow each other in one flat region, or one other face.
  struct Run {
    std::uint32_t first = 0, last = 0;  ///< in `ring`, the last excluded
    std::uint32_t region = kNone;
    Vec3 normal{0.0}, x{0.0}, y{0.0};  ///< of the region; x along the first face's edge
  };
  std::uint32_t vertex = kNone;
  std::vector<CornerOfTriangle> ring;  ///< counter-clockwise, from the boundary where there is one
  std::vector<double> angles;  ///< as `ring`: of the edge that starts at the face's corner, from its run's x, ascending
  std::vector<Run> runs;

  /// Faces of a run that matter to a direction: its first and last, that under the foot, and its neighbours; ascending,
  /// some twice.
  std::array<std::uint32_t, 5> towards(const Run& run, const Vec3& direction) const;
};

/// All of a mesh, by ascending vertex.
std::vector<CrowdedVertex> crowded_vertices(const ContactMesh& mesh);

}  // namespace tangent
