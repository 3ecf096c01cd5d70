// The paper's figures that this program reproduces with its own algorithms.
#pragma once

#include "core/lab/measure/curvature_deviation.h"
#include "core/planar/curve.h"
#include "workbench/session/figure_table.h"

#include <utility>

namespace tangent {

Figure contact_location_figure();  ///< Fig. 4: contact location on the finger over a smooth curve, two and three facets
Figure iterations_figure();        ///< Fig. 6: the tangent planes of one tick, on a patch in space
Figure travel_figure();            ///< Fig. 7: the travel, projected on the base triangle
Figure patches_figure();           ///< Fig. 15: polygon, smooth curve, patches
Figure labels_figure();            ///< Fig. 16: one patch with its labels
Figure tangents_figure();          ///< Fig. 17: three tangent lines a patch, local centres at midpoints
Figure angles_figure();            ///< Fig. 18: the part of the angle about the local centre
Figure lines_figure();             ///< the tangent lines of one tick of the 2D algorithm
Figure conditions_figure(bool at_threshold);  ///< force direction and contact location against travel, all conditions:
                                              ///< at each one's threshold count of segments, or all at five
Figure curvature_figure();                    ///< curvature against the circle's, five segments

Figure inner_corner_figure();  ///< force over time in an inner corner, as decided, faded, from both walls

/// The curve of an outline written in this program, and so a good one.
inline PlanarCurve curve_of(PlanarPolygon polygon) { return std::move(*PlanarCurve::build(std::move(polygon))); }

struct DeviationRow {
  int segments;
  ArcPlacement placement;
  LocalCentre centre;
  CurvatureDeviation deviation;
};
/// Tangent and inscribed placement, both centres, 3, 5, 9 and 16 segments.
std::vector<DeviationRow> deviation_rows();

/// Segments on the paper's arc at a condition's threshold: the paper's counts; for the pilot ones from the angle.
int threshold_segments(std::string_view condition);

}  // namespace tangent
