#include "workbench/gui/theme/palette.h"

#include "workbench/gui/theme/colour_map.h"

#include <algorithm>

namespace tangent {

Rgba iteration_colour(std::size_t i, std::size_t count) {
  const float t = count > 1 ? static_cast<float>(std::min(i, count - 1)) / static_cast<float>(count - 1) : 1.0f;
  return colour_at(ColourMap::tide, 0.1f + 0.9f * t);
}

}  // namespace tangent
