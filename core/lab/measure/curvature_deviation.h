// How far the 2D algorithm's curve over a polygon of a circle is from the circle, as curvature.
#pragma once

#include "core/lab/objects/arc.h"
#include "core/planar/curve.h"

namespace tangent {

struct CurvatureDeviation {
  double rms = 0.0;      ///< of (curvature times radius) - 1, weighted by the way along the curve, 1
  double largest = 0.0;  ///< magnitude, 1
};

/// Over the whole patches of the paper's arc; the curvature is that of the rendered curve: |dN| over the way of the
/// contact (rendered_curvature). All patches of an arc are alike, so one is sampled, at `samples` places. Precondition:
/// segments >= 2.
CurvatureDeviation curvature_deviation(int segments, ArcPlacement placement, LocalCentre centre, int samples = 4000);

}  // namespace tangent
