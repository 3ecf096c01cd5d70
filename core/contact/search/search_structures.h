// What searches read of a mesh besides its patches.
#pragma once

#include "core/contact/nearest_triangles.h"
#include "core/contact/prove/late_hierarchy.h"

namespace tangent {

struct SearchStructures {
  const NearestTriangles& nearest;  ///< of the raw mesh
  const LateHierarchy& hierarchy;   ///< of the smooth surface: boxes and cones of normals
};

}  // namespace tangent
