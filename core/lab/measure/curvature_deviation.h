// Relative error of curvature of the 2D algorithm's curve over a polygon of a circle.
#pragma once

#include "core/lab/objects/arc.h"
#include "core/planar/curve.h"

namespace tangent {

struct CurvatureDeviation {
  double rms = 0.0;      ///< of (curvature times radius) - 1, weighted by arc length, 1
  double largest = 0.0;  ///< magnitude, 1
};

/// Over the complete patches of the paper's arc. The curvature is that of the rendered curve: |dN| per path length of
/// the contact (rendered_curvature). All patches of an arc are congruent, so one is sampled, at `samples` places.
/// Precondition: segments >= 2.
CurvatureDeviation curvature_deviation(int segments, ArcPlacement placement, LocalCentre centre, int samples = 4000);

}  // namespace tangent
