// Facts about a 2D scene's polygon.
#pragma once

#include "core/planar/polygon.h"

#include <cstddef>

namespace tangent {

struct PolygonFacts {
  std::size_t vertices = 0;  ///< distinct vertices; a vertex given twice counts once
  std::size_t corners = 0;   ///< vertices given twice, which stay sharp
  std::size_t segments = 0;  ///< of nonzero length
  double length_m = 0.0;     ///< total length
  Vec2 size_m{0.0};
};
PolygonFacts facts_of(const PlanarPolygon& polygon);

}  // namespace tangent
