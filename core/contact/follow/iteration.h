// What one run of the iteration leaves behind: the last tangent plane, and what is known of the contact there.
#pragma once

#include "core/contact/context.h"
#include "core/contact/tracked_plane.h"
#include "core/finger/plane_contact.h"

namespace tangent {

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
  bool facing() const { return stop == StopReason::facing; }
};

}  // namespace tangent
