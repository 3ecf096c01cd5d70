// Which vectors of a list are exactly equal: the only rule by which vertices become one vertex here. No distance
// tolerance: whether two points are "near" depends on the scale of the mesh, whether they are equal does not.
#pragma once

#include "core/base/run_both.h"
#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

struct Weld {
  std::vector<std::uint32_t> id;     ///< per vector: its group, numbered by first appearance; kNone if left out
  std::vector<std::uint32_t> first;  ///< per group: the first vector in it
  std::uint32_t count() const { return static_cast<std::uint32_t>(first.size()); }
};

/// Groups equal vectors (-0.0 equals 0.0). Vectors that are not finite, or have a component beyond
/// `largest`, are left out. Linear time. Precondition: fewer than 2^31 vectors. The same bits however `run_both` works.
Weld weld_exact(std::span<const Vec3> vectors, double largest, const RunBoth& run_both = run_in_turn);

}  // namespace tangent
