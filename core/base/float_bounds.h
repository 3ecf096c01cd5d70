// Doubles as floats that bound them.
#pragma once

#include <cmath>
#include <limits>

namespace tangent {

inline float below(double x) { return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity()); }
inline float above(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

}  // namespace tangent
