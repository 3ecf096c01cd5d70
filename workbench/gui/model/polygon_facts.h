// What there is to say of a 2D scene's polygon.
#pragma once

#include "core/planar/polygon.h"

#include <cstddef>

namespace tangent {

struct PolygonFacts {
  std::size_t vertices = 0;  ///< places; one that is given twice counts once
  std::size_t corners = 0;   ///< vertices given twice: they stay sharp
  std::size_t segments = 0;  ///< of some length
  double length_m = 0.0;     ///< of all of them
  Vec2 size_m{0.0};
};
PolygonFacts facts_of(const PlanarPolygon& polygon);

}  // namespace tangent
