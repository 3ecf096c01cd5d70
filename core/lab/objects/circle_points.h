// Points on the unit circle with exact symmetries (bitwise).
#pragma once

#include "core/base/vec.h"

#include <cstdint>

namespace tangent {

/// (cos, sin) of the angle numerator/denominator turns. Reflections in both axes and both diagonals
/// give exactly mirrored coordinates. Precondition: denominator > 0.
Vec2 circle_point(std::int64_t numerator, std::int64_t denominator);

}  // namespace tangent
