// Closed parts of a mesh whose faces look inwards: a finger would feel them from within.
#pragma once

#include "core/mesh/corner_normals.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

struct InsideOut {
  std::uint32_t parts = 0;
  std::uint64_t triangles = 0;
  double volume_m3 = 0.0;           ///< signed, of all those parts: negative
  std::vector<std::uint8_t> found;  ///< by triangle, 1: of such a part; empty where there is none

  bool any() const { return parts > 0; }
};

/// A part is what hangs together over links; it is closed where none of its edges is a boundary. Its signed volume
/// tells which way it looks. One that looks inwards within the box of a closed part that looks outwards bounds a cavity
/// of that and is as it should be; within the box of one that is inside out it is turned with that.
InsideOut find_inside_out(const SurfaceView& surface, const RunBoth& run_both = run_in_turn);

/// Turns the triangles that `turned` names: their second and third corners change places, and links follow.
/// Precondition: with a triangle, `turned` names all that hang together with it.
void turn_over(const std::vector<std::uint8_t>& turned, std::span<Index3> triangles, std::span<Index3> links);

/// The same for their corner normals, which are turned to the other side, but for those of parts where they point
/// outwards already: where the sum of normal times face normal is positive. Precondition: `surface` is turned over.
void turn_normals_over(const std::vector<std::uint8_t>& turned, const SurfaceView& surface, CornerNormals& normals);

}  // namespace tangent
