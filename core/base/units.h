// Everything inside is SI. These factors are for the places where another unit comes in or goes out.
#pragma once

#include <numbers>

namespace tangent {

inline constexpr double kMillimetre = 1e-3;                  // m
inline constexpr double kMicrometre = 1e-6;                  // m
inline constexpr double kDegree = std::numbers::pi / 180.0;  // rad

}  // namespace tangent
