#include "workbench/gui/model/polygon_facts.h"

namespace tangent {

PolygonFacts facts_of(const PlanarPolygon& polygon) {
  PolygonFacts facts;
  if (polygon.vertices.empty()) return facts;
  Vec2 low = polygon.vertices.front(), high = low;
  const std::size_t count = polygon.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 &here = polygon.vertices[i], &next = polygon.vertices[(i + 1) % count];
    low = glm::min(low, here);
    high = glm::max(high, here);
    if (i + 1 == count && !polygon.closed) break;
    if (here == next)
      ++facts.corners;
    else
      ++facts.segments;
    facts.length_m += glm::length(next - here);
  }
  facts.vertices = count - facts.corners;
  facts.size_m = high - low;
  return facts;
}

}  // namespace tangent
