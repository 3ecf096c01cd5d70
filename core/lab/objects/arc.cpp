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

double ArcStimulus::run_out_m() const { return radius_m * std::tan(0.25 * angle_rad); }

PlanarPolygon ArcStimulus::exact() const {
  constexpr int kViewSegments = 64;
  PlanarPolygon polygon = *this->polygon(kViewSegments, ArcPlacement::tangent);
  polygon.name = "exact arc";
  polygon.exact = ExactArc{Vec2(0.0), radius_m, 0.5 * angle_rad, run_out_m()};
  return polygon;
}

Result<PlanarPolygon> ArcStimulus::polygon(int segments, ArcPlacement placement) const {
  constexpr int kMostSegments = 100'000;
  const bool tangent = placement == ArcPlacement::tangent;
  const int fewest = tangent ? 3 : 1;
  if (segments < fewest || segments > kMostSegments)
    return fail("an arc of " + std::to_string(segments) + " segments", tangent ? "tangent" : "inscribed",
                "use " + std::to_string(fewest) + " to " + std::to_string(kMostSegments));
  const double half = 0.5 * angle_rad, turn = angle_rad / (tangent ? segments - 1 : segments);
  // Corners that lie within the arc's angle; tangent segments meet between their midpoints.
  const int corners = tangent ? segments - 1 : segments + 1;
  const double first = tangent ? 0.5 * turn - half : -half;
  const double distance = tangent ? radius_m / std::cos(0.5 * turn) : radius_m;
  const auto place = [&](int i) {
    const double angle = first + turn * i;
    return Vec2(distance * std::sin(angle), distance * std::cos(angle));
  };
  // Half a segment from the arc's end, where the first tangent one begins: its midpoint is the end itself.
  constexpr double kSameLength = 1e-9;
  const double begins = tangent ? radius_m * std::tan(0.5 * turn) : 0.0, run_out = run_out_m();
  const auto beyond = [&](double side, double way) {
    return Vec2(side * (radius_m * std::sin(half) + way * std::cos(half)),
                radius_m * std::cos(half) - way * std::sin(half));
  };
  const bool has_more = begins < (1.0 - kSameLength) * run_out;
  PlanarPolygon out;
  out.name = "arc of " + std::to_string(segments) + (tangent ? " tangent segments" : " inscribed segments");
  out.vertices.push_back(beyond(-1.0, run_out));
  if (tangent && has_more) out.vertices.push_back(beyond(-1.0, begins));
  for (int i = 0; i < corners; ++i) out.vertices.push_back(place(i));
  if (tangent && has_more) out.vertices.push_back(beyond(1.0, begins));
  out.vertices.push_back(beyond(1.0, run_out));
  return out;
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
