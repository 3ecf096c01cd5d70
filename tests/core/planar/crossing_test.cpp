// Whether a polygon meets itself: the sweep against comparing every pair, and polygons of which the sweep's line meets
// all segments at once.
#include "core/planar/crossing.h"

#include "core/planar/polygon.h"
#include "tests/core/scenes.h"

#include <algorithm>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

std::vector<PlanarSegment> segments_through(const std::vector<Vec2>& v, bool closed) {
  std::vector<PlanarSegment> out;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < v.size(); ++i) out.push_back({v[i], v[(i + 1) % v.size()], i});
  return out;
}

/// Whether the places of two segments overlap: ends on the other's line count as touching.
bool meet(const PlanarSegment& p, const PlanarSegment& q) {
  const auto sides = [](const PlanarSegment& s, const PlanarSegment& t) {
    const double c = cross(s.b - s.a, t.a - s.a), d = cross(s.b - s.a, t.b - s.a);
    return std::pair(std::min(c, d), std::max(c, d));
  };
  const auto [p_least, p_most] = sides(p, q);
  const auto [q_least, q_most] = sides(q, p);
  if (p_least > 0.0 || p_most < 0.0 || q_least > 0.0 || q_most < 0.0) return false;
  const Vec2 gap_low = glm::max(glm::min(p.a, p.b), glm::min(q.a, q.b)),
             gap_high = glm::min(glm::max(p.a, p.b), glm::max(q.a, q.b));
  return gap_low.x <= gap_high.x && gap_low.y <= gap_high.y;
}

bool follow_one_another(std::size_t i, std::size_t j, std::size_t count, bool closed) {
  return j - i == 1 || (closed && j - i == count - 1);
}

bool any_meet(const std::vector<PlanarSegment>& segments, bool closed) {
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size(); ++j)
      if (!follow_one_another(i, j, segments.size(), closed) && meet(segments[i], segments[j])) return true;
  return false;
}

bool any_folds_back(const std::vector<PlanarSegment>& segments, bool closed) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < segments.size(); ++i) {
    const PlanarSegment &s = segments[i], &next = segments[(i + 1) % segments.size()];
    if (glm::dot(s.b - s.a, next.b - next.a) < 0.0 && cross(s.b - s.a, next.b - next.a) == 0.0) return true;
  }
  return false;
}

/// Teeth of the polygon's whole width, along `way`.
std::vector<Vec2> comb(int teeth, const Vec2& way) {
  const Vec2 up(-way.y, way.x);
  std::vector<Vec2> v;
  for (int i = 0; i < teeth; ++i) {
    const double y = static_cast<double>(i) / teeth;
    v.push_back(y * up + (i % 2 == 0 ? 0.0 : 1.0) * way);
    v.push_back(y * up + (i % 2 == 0 ? 1.0 : 0.0) * way);
  }
  return v;
}

}  // namespace

TEST_CASE("the sweep finds a crossing where comparing every pair of segments does, and names two that meet") {
  Random random(3);
  int crossing = 0, clean = 0;
  for (int polygon = 0; polygon < 4000; ++polygon) {
    const auto count = 3 + static_cast<std::size_t>(random.in(0.0, 12.0));
    const bool closed = random.in(0.0, 1.0) < 0.5, on_a_grid = random.in(0.0, 1.0) < 0.5;
    std::vector<Vec2> v;
    while (v.size() < count) {
      Vec2 at(random.in(0.0, 1.0), random.in(0.0, 1.0));
      if (on_a_grid) at = glm::floor(8.0 * at);  // vertices on vertices, on segments, vertical segments
      if (v.empty() || (v.back() != at && (v.size() + 1 < count || at != v.front()))) v.push_back(at);
    }
    const std::vector<PlanarSegment> segments = segments_through(v, closed);
    if (any_folds_back(segments, closed)) continue;
    const auto found = find_crossing(segments, closed);
    CAPTURE(polygon);
    REQUIRE(found.has_value() == any_meet(segments, closed));
    (found ? crossing : clean) += 1;
    if (!found) continue;
    CHECK(found->first < found->second);
    CHECK_FALSE(follow_one_another(found->first, found->second, segments.size(), closed));
    CHECK(meet(segments[found->first], segments[found->second]));
  }
  CHECK(crossing > 1000);
  CHECK(clean > 500);
}

TEST_CASE("200,000 teeth as wide as the polygon are checked in any direction, and a crossing in them is found") {
  // A sweep that compares all the segments it meets would make 10^11 comparisons: minutes.
  for (const Vec2 way : {Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.8, 0.6), Vec2(-0.6, 0.8)}) {
    std::vector<Vec2> v = comb(rounds(200000), way);
    CHECK_FALSE(find_crossing(segments_through(v, false), false).has_value());
    v.push_back(0.5 * (v[1000] + v[1001]));
    CHECK(find_crossing(segments_through(v, false), false).has_value());
  }
}
