// Poses for runs without a pose file: the simulated hand's path over the mesh, at the paper's speed.
#pragma once

#include "core/tick/step.h"

#include <vector>

namespace tangent {

inline constexpr double kExplorationSpeed = 0.1;   ///< m/s, of the finger's centre
inline constexpr double kExplorationTick = 1e-3;   ///< s
inline constexpr double kExplorationPress = 1e-3;  ///< m; at most a 20th of the mesh's longest side

struct ExplorationPoses {
  std::vector<TickInput> poses;
  double length_m = 0.0;  ///< of the closed path
  double press_m = 0.0;
  bool whole = true;  ///< false: the path is longer than the ticks allowed
};

/// Once around the path of workbench/session/exploration_path.h, 1 ms per tick, at most 100,000 ticks. Deterministic.
ExplorationPoses exploration_poses(const ContactScene& scene, const Finger& finger);

}  // namespace tangent
