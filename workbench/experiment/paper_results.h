// What the paper reports, to stand beside what comes out here: Doxon, Johnson, Tan & Provancher, "Force and Contact
// Location Shading Methods for Use Within Two- and Three-Dimensional Polygonal Environments", section 5.
#pragma once

#include <array>
#include <string_view>

namespace tangent::experiment {

/// Table 1 (5.2.6): twelve participants. Angles: the means are 51.68 / (n - 1) degrees, the ends of the intervals
/// 51.68 / n: the paper's own two readings.
struct PaperThreshold {
  std::string_view condition;
  double segments;       ///< mean threshold
  double half_interval;  ///< of 95 %
  double degrees;        ///< as printed
};
inline constexpr std::array<PaperThreshold, 4> kPaperThresholds{{
    {"C1", 104.1, 35.32, 0.5},
    {"C2", 16.3, 1.99, 3.4},
    {"C3", 257.3, 63.20, 0.2},
    {"C4", 15.6, 3.85, 3.5},
}};
/// Table 2: of the pilot study alone.
inline constexpr double kPaperP1Degrees = 14.8, kPaperP2Degrees = 0.2;
inline constexpr int kPaperDiscriminationParticipants = 12;
inline constexpr double kPaperAnovaF = 47.76;  ///< 5.2.6
inline constexpr double kPaperTrials = 42.0;   ///< of a condition, on average, 5.2.4

/// The objects of experiment 2 in the order of its keys, 1 to 7 (5.3.2, Table 3).
inline constexpr std::array<std::string_view, 7> kPaperObjects{"cone",        "cylinder", "cube",    "sphere",
                                                               "tetrahedron", "octagon",  "triangle"};
/// Table 3 (5.3.6): percent of answers (columns) to each object (rows), 18 participants pooled.
inline constexpr std::array<std::array<double, 7>, 7> kPaperConfusionPercent{{
    {83.3, 4.5, 0.3, 1.7, 8.3, 0.3, 1.4},
    {1.7, 88.2, 5.9, 0.0, 1.0, 1.7, 1.4},
    {2.1, 3.1, 81.6, 2.1, 0.7, 4.9, 5.6},
    {0.3, 0.7, 0.0, 97.6, 0.3, 1.0, 0.0},
    {20.1, 0.3, 0.3, 3.8, 70.5, 1.0, 3.8},
    {1.0, 6.9, 3.5, 0.0, 1.7, 83.7, 3.1},
    {2.4, 4.2, 3.8, 0.7, 10.1, 10.4, 68.4},
}};
inline constexpr int kPaperIdentificationParticipants = 18;
inline constexpr double kPaperAccuracyPercent = 81.9, kPaperAccuracyDeviation = 10.0;        ///< 5.3.6.1
inline constexpr double kPaperForceOnlyPercent = 82.5, kPaperForceTactilePercent = 81.3;     ///< 5.3.6.3
inline constexpr double kPaperExperiencedPercent = 87.5, kPaperInexperiencedPercent = 76.3;  ///< 5.3.6.4
inline constexpr double kPaperSphereSeconds = 8.6, kPaperTriangleSeconds = 18.7;             ///< 5.3.6.5

}  // namespace tangent::experiment
