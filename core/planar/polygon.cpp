#include "core/planar/polygon.h"

#include "core/base/tolerances.h"
#include "core/planar/crossing.h"

#include <algorithm>
#include <cmath>

namespace tangent {

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

double signed_area_m2(const PlanarPolygon& polygon) {
  const std::vector<Vec2>& v = polygon.vertices;
  double twice = 0.0;
  // Relative to a vertex, so that a polygon far from the origin keeps its digits.
  for (std::size_t i = 1; i + 1 < v.size(); ++i) twice += cross(v[i] - v[0], v[i + 1] - v[0]);
  return 0.5 * twice;
}

namespace {

/// Ends of an open polygon nearer than this part of its mean segment were meant to be one vertex.
constexpr double kNearlyClosed = 1e-3;
/// Sine of the angle within which a segment lies on the one before.
constexpr double kFoldedSine = 1e-9;

/// Segments that have a length, in order.
std::vector<PlanarSegment> segments_of(const PlanarPolygon& polygon) {
  const std::vector<Vec2>& v = polygon.vertices;
  std::vector<PlanarSegment> out;
  const std::size_t count = polygon.closed ? v.size() : v.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 b = v[(i + 1) % v.size()];
    if (v[i] != b) out.push_back({v[i], b, i});
  }
  return out;
}

std::string number(std::size_t i) { return "vertex " + std::to_string(i); }

Status check_vertices(const PlanarPolygon& polygon) {
  const std::vector<Vec2>& v = polygon.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    // Written so that a NaN is refused.
    if (!(std::abs(v[i].x) <= kLargestCoordinate && std::abs(v[i].y) <= kLargestCoordinate))
      return fail(number(i) + " is not a finite place", polygon.name, "write finite coordinates");
  }
  std::vector<Vec2> different = v;
  std::sort(different.begin(), different.end(),
            [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto count = std::unique(different.begin(), different.end()) - different.begin();
  if (count < 3)
    return fail("only " + std::to_string(count) + " different " + (count == 1 ? "vertex" : "vertices"), polygon.name,
                "a polygon needs three or more");
  if (v.size() > kMostPlanarVertices)
    return fail(std::to_string(v.size()) + " vertices", polygon.name, "use 1,000,000 or fewer");
  return {};
}

Status check_repeats(const PlanarPolygon& polygon) {
  const std::vector<Vec2>& v = polygon.vertices;
  const std::size_t n = v.size();
  if (!polygon.closed && (v[0] == v[1] || v[n - 2] == v[n - 1]))
    return fail("the " + std::string(v[0] == v[1] ? "first" : "last") + " vertex is repeated", polygon.name,
                "a vertex twice in a row is a sharp corner, which needs a segment on both sides");
  for (std::size_t i = 0; i < (polygon.closed ? n : n - 2); ++i) {
    if (v[i] == v[(i + 1) % n] && v[i] == v[(i + 2) % n])
      return fail(number(i) + " is there three times or more in a row", polygon.name,
                  "twice makes a sharp corner; leave the others out");
  }
  return {};
}

Status check_folds(const PlanarPolygon& polygon, const std::vector<PlanarSegment>& segments) {
  for (std::size_t i = 0; i + (polygon.closed ? 0 : 1) < segments.size(); ++i) {
    const PlanarSegment& next = segments[(i + 1) % segments.size()];
    const Vec2 a = segments[i].b - segments[i].a, b = next.b - next.a;
    const double scale = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
    if (glm::dot(a, b) < 0.0 && std::abs(cross(a, b)) <= kFoldedSine * scale)
      return fail("the polygon folds back onto itself at " + number(next.from), polygon.name,
                  "take the vertex out or move it aside");
  }
  return {};
}

Status check_ends(const PlanarPolygon& polygon, const std::vector<PlanarSegment>& segments) {
  if (polygon.closed) return {};
  double length = 0.0;
  for (const PlanarSegment& s : segments) length += glm::length(s.b - s.a);
  const double gap = glm::length(polygon.vertices.back() - polygon.vertices.front());
  if (gap >= kNearlyClosed * length / static_cast<double>(segments.size())) return {};
  return fail("the polygon is not closed, but its ends all but meet (" + std::to_string(gap * 1e6) + " um apart)",
              polygon.name, "to close it, repeat the first vertex at the end, exactly");
}

}  // namespace

Status check_polygon(const PlanarPolygon& polygon) {
  if (polygon.exact)
    if (Status status = check_exact_arc(*polygon.exact, polygon.name); !status) return status;
  if (Status status = check_vertices(polygon); !status) return status;
  if (Status status = check_repeats(polygon); !status) return status;
  const std::vector<PlanarSegment> segments = segments_of(polygon);
  if (Status status = check_ends(polygon, segments); !status) return status;
  if (Status status = check_folds(polygon, segments); !status) return status;
  if (const auto crossing = find_crossing(segments, polygon.closed))
    return fail("the polygon crosses or touches itself: the segments after vertices " +
                    std::to_string(segments[crossing->first].from) + " and " +
                    std::to_string(segments[crossing->second].from),
                polygon.name, "move the vertices apart");
  return {};
}

void fit_polygon(PlanarPolygon& polygon, double longest_m) {
  Vec2 low = polygon.vertices.front(), high = low;
  for (const Vec2& v : polygon.vertices) low = glm::min(low, v), high = glm::max(high, v);
  const Vec2 centre = 0.5 * (low + high), size = high - low;
  const double scale = longest_m / std::max(size.x, size.y);
  for (Vec2& v : polygon.vertices) v = scale * (v - centre);
}

}  // namespace tangent
