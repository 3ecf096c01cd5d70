#include "core/lab/objects/arc.h"

#include <cmath>
#include <numbers>

namespace tangent {

double facet_turn_rad(int segments, ArcPlacement placement) {
  return kPaperArcRad / static_cast<double>(placement == ArcPlacement::tangent ? segments - 1 : segments);
}

PlanarPolygon make_paper_arc(int segments, ArcPlacement placement, int beyond, double radius_m) {
  const double turn = facet_turn_rad(segments, placement);
  const double distance = placement == ArcPlacement::tangent ? radius_m / std::cos(0.5 * turn) : radius_m;
  PlanarPolygon polygon;
  polygon.name = "arc of " + std::to_string(segments) +
                 (placement == ArcPlacement::tangent ? " tangent" : " inscribed") + " facets";
  const int facets = segments + 2 * beyond;
  for (int i = 0; i <= facets; ++i) {
    const double angle = (static_cast<double>(i) - 0.5 * static_cast<double>(facets)) * turn;
    polygon.vertices.emplace_back(distance * std::sin(angle), distance * std::cos(angle));
  }
  return polygon;
}

PlanarPolygon make_regular_polygon(int sides, double radius_m, ArcPlacement placement) {
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(sides);
  const double distance = placement == ArcPlacement::tangent ? radius_m / std::cos(0.5 * turn) : radius_m;
  PlanarPolygon polygon;
  polygon.name = "regular polygon of " + std::to_string(sides) + " sides";
  polygon.closed = true;
  for (int i = 0; i < sides; ++i)
    polygon.vertices.emplace_back(distance * std::cos(turn * i), distance * std::sin(turn * i));
  return polygon;
}

}  // namespace tangent
