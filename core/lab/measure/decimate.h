// Decimation under a perception threshold: the fewest triangles that a finger can't tell from the original.
//
// OpenMesh's decimater collapses half-edges, cheapest first by quadric error, as long as no smooth edge it makes
// exceeds the angle at which facets are felt, and the smooth surface over the new triangles stays near the smooth
// surface over the old ones. Vertices stay where they are and keep their normals; vertices on creases and boundaries
// stay.
#pragma once

#include "core/tick/step.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tangent {

struct DecimateLimits {
  double angle_deg = 0.0;  ///< largest angle between facets across a smooth edge that a collapse may leave
  double deviation_m =
      0.0;               ///< largest distance of the new smooth surface from the old one, along the old one's normal
  double aspect = 12.0;  ///< longest side over smallest height of a new triangle, unless the old ones were worse
};

struct DecimateResult {
  PolygonMesh mesh;                     ///< triangles with normals at the corners, metres, world
  std::uint64_t before = 0, after = 0;  ///< triangles
  int passes = 0;
  bool stopped = false;  ///< `keep_going` returned false; the mesh is valid, but not as coarse as possible
};

/// Precondition: limits positive. `keep_going` is polled; false stops.
DecimateResult decimate(const ContactScene& original, const DecimateLimits& limits,
                        const std::function<bool()>& keep_going = {});

/// Distances of samples of one smooth surface from another, m.
struct SurfaceDeviation {
  std::uint64_t samples = 0;
  std::uint64_t unresolved = 0;  ///< samples without a contact, left out
  double mean_m = 0.0, rms_m = 0.0, largest_m = 0.0;
};

/// One-sided distance of points on the smooth surface over `from` to that over `to`, by solving for each point's
/// contact. At most `most` samples, spread over the triangles.
SurfaceDeviation surface_deviation(const ContactScene& from, const ContactScene& to, std::uint64_t most);

}  // namespace tangent
