// The iteration of one tick: from a place on the surface, tangent plane after tangent plane, until the
// finger's contact on the plane is the point where the plane touches.
#pragma once

#include "core/contact/place.h"

namespace tangent {

/// What stays the same through the iterations of one tick.
struct IterationContext {
  PatchCache& cache;
  const SolverSettings& settings;
  const Finger& finger;
  const FingerPose& pose;  ///< local mesh coordinates
  Vec3 origin;             ///< of the local coordinates, for the trace
  IterationTrace* trace = nullptr;
  std::uint8_t seed = 0;  ///< 0 while tracking; the number of the seed otherwise
};

/// Stability of the contact: M = B A^-1.
struct Stability {
  double det = 1.0, trace = 2.0;
  bool stable() const { return det > 0.0 && trace > 0.0; }
};

/// How the normals of a face bend around a sample, whatever the finger: for a round one the stability of a contact
/// follows from it and the height alone, with k1 and k2 the curvatures of the interpolated normals.
struct NormalBend {
  double regular = 1.0;         ///< 0: the patch is singular there
  double sum_per_m = 0.0;       ///< k1 + k2
  double product_per_m2 = 0.0;  ///< k1 k2
  double area_m2 = 0.0;         ///< S_u x S_v . N
  /// det M = (1 + h k1)(1 + h k2), trace M = 2 + h (k1 + k2)
  Stability at_height(double h) const {
    return {regular + h * (sum_per_m + h * product_per_m2), 2.0 * regular + h * sum_per_m};
  }
};

struct IterationResult {
  TrackedPlane plane;    ///< the last plane
  SurfaceSample sample;  ///< there
  NormalBend bend;       ///< there, on a face
  PlaneContact contact;  ///< of the finger with it
  Stability stability;   ///< there
  StopReason stop = StopReason::going_on;
  int evaluations = 0;  ///< new planes
  int triangle_changes = 0;
  bool met_unstable = false;  ///< an iterate on the way was not stable
  bool converged() const { return stop == StopReason::converged; }
};

/// Iterates by `context.settings.method` (paper, newton or robust) from `start` until converged or `budget` new
/// planes are spent.
void iterate(IterationContext& context, const SurfacePlace& start, int budget, IterationResult& result);

/// The same from the plane kept from the last tick, which costs no evaluation. `sample_kept`: result.plane and
/// result.sample still hold that plane (a face or an edge) and needn't be computed again.
void iterate_kept(IterationContext& context, const TrackedPlane& kept, bool sample_kept, int budget,
                  IterationResult& result);

/// Sample of a place for the present pose: faces as they are, edges and vertices with the normal turned to
/// face the finger within the fan. Fills plane.point and plane.normal.
void sample_place(IterationContext& context, TrackedPlane& plane, SurfaceSample& sample);

}  // namespace tangent
