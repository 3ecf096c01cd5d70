// Polygonal approximations of round shapes: the paper's arc, and circles.
#pragma once

#include "core/planar/polygon.h"

namespace tangent {

/// The arc of the paper's experiments: 0.902 rad of a circle of 100 mm radius, 90.2 mm of way (Doxon et al. 5.2.2).
inline constexpr double kPaperArcRad = 0.902, kPaperArcRadius = 0.100;

enum class ArcPlacement : std::uint8_t {
  tangent,    ///< facets of angle/(n-1) rad that touch the arc at their midpoints: the paper's segment counts
  inscribed,  ///< n facets of angle/n rad with their ends on the arc
};

/// Angle between neighbouring facets, rad.
double facet_turn_rad(int segments, ArcPlacement placement);

/// About the origin, symmetric to the y axis, from left to right over the top, so that the finger comes from above.
/// `beyond`: further facets of the same turn at either end, so that the arc itself is covered by whole patches (one
/// is enough). Precondition: segments >= 2 (tangent) or 1 (inscribed); the whole turns by less than a circle.
PlanarPolygon make_paper_arc(int segments, ArcPlacement placement = ArcPlacement::tangent, int beyond = 1,
                             double radius_m = kPaperArcRadius);

/// An arc as it is put before a participant, exact or as segments, symmetric to the y axis about the origin. At either
/// end all of them go on straight, along the arc's tangent, for run_out_m(): half a facet of the coarsest (three
/// tangent segments), so that the ends feel alike whatever the number of segments.
struct ArcStimulus {
  double angle_rad = kPaperArcRad, radius_m = kPaperArcRadius;
  double run_out_m() const;
  /// A circle, with a polygon of 64 segments beside it for views.
  PlanarPolygon exact() const;
  /// Fails on fewer than three tangent segments, one inscribed, or more than 100,000.
  Result<PlanarPolygon> polygon(int segments, ArcPlacement placement) const;
};

/// Regular polygon, closed, counter-clockwise, about the origin; vertices on the circle, or facets tangent to it.
PlanarPolygon make_regular_polygon(int sides, double radius_m, ArcPlacement placement = ArcPlacement::inscribed);

}  // namespace tangent
