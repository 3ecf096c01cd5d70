// Largest angle between adjacent facets at which a surface feels smooth, per rendering condition.
// Source: Doxon, Johnson, Tan & Provancher, "Force and Contact Location Shading Methods for Use Within
// Two- and Three-Dimensional Polygonal Environments": means and 95 % intervals; P1 and P2 from the pilot
// study alone, without interval.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace tangent {

struct PerceptionThreshold {
  std::string_view condition;
  double mean_deg;
  std::optional<std::pair<double, double>> interval_deg;  ///< 95 %
};

inline constexpr std::array<PerceptionThreshold, 6> kPerceptionThresholds{{
    {"C1", 0.5, {{0.37, 0.75}}},
    {"C2", 3.4, {{3.05, 3.84}}},
    {"C3", 0.2, {{0.16, 0.27}}},
    {"C4", 3.5, {{2.84, 4.59}}},
    {"P1", 14.8, std::nullopt},
    {"P2", 0.2, std::nullopt},
}};

}  // namespace tangent
