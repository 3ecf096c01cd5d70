// Poses for runs that name no pose file: a path over the mesh at about the paper's speed.
#pragma once

#include "core/tick/step.h"

#include <array>
#include <string_view>
#include <vector>

namespace tangent {

enum class ExplorationKind : std::uint8_t {
  around,   ///< the simulated hand's way all over the mesh (exploration_path.h)
  strokes,  ///< the paper's: left and right, then forward and back (stroke_path.h)
};
inline constexpr std::array<std::string_view, 2> kExplorationNames{"around", "strokes"};  // order of ExplorationKind

/// `varied`: speed and depth swing about their means. At one depth all along, G_d of Eq. 1 does the same as G_o and
/// can't be told from it.
enum class ExplorationPace : std::uint8_t { steady, varied };

inline constexpr double kExplorationTick = 1e-3;                                     ///< s
inline constexpr double kExplorationSpeed = 0.1, kExplorationPress = 1e-3;           ///< m/s of the finger's centre; m
inline constexpr double kExplorationSpeedSwing = 0.5, kExplorationPressSwing = 0.6;  ///< share of the mean
/// Way of one swing, m. Not multiples of each other, so that every depth is met at every speed.
inline constexpr double kExplorationSpeedWave = 0.031, kExplorationPressWave = 0.019;

/// One more whenever any of these motions is made otherwise than before, so that what was measured along the old one is
/// not taken for a change of the solver.
inline constexpr int kExplorationVersion = 1;

struct ExplorationPoses {
  std::vector<TickInput> poses;
  double length_m = 0.0;  ///< of the closed path
  double way_m = 0.0;     ///< of it that the poses cover
  double press_m = 0.0;   ///< mean; on meshes under 20 mm less, a 20th of their longest side
  bool whole() const { return way_m >= length_m; }
};

/// Once around the path, 1 ms a tick, but no more than 100,000 ticks. Deterministic. Fails where strokes find nothing
/// to stroke. `press_m`: mean depth, on meshes under 20 times that less.
Result<ExplorationPoses> exploration_poses(const ContactScene& scene, const Finger& finger, ExplorationKind kind,
                                           ExplorationPace pace, double press_m = kExplorationPress);

}  // namespace tangent
