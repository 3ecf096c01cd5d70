#include "workbench/cli/exploration_poses.h"

#include "workbench/session/exploration_path.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr double kMostTicks = 100000.0;
constexpr double kPressShare = 0.05;  // of the mesh's longest side

}  // namespace

ExplorationPoses exploration_poses(const ContactScene& scene, const Finger& finger) {
  ExplorationPoses result;
  const double pad = pad_distance_m(finger);
  const ExplorationPath path = ExplorationPath::build(scene, pad);
  const Vec3 size = scene.mesh().bounds().size();
  result.length_m = path.length_m();
  result.press_m = std::min(kExplorationPress, kPressShare * std::max({size.x, size.y, size.z}));
  constexpr double kStep = kExplorationSpeed * kExplorationTick;  // m a tick
  const double ticks = std::clamp(result.length_m / kStep, 1.0, kMostTicks);
  result.whole = result.length_m / kStep <= kMostTicks;
  for (int i = 0; i < static_cast<int>(ticks); ++i) {
    const PathPose pose = path.at(kStep * i, pad, result.press_m);
    result.poses.push_back({kExplorationTick * i, {pose.position_m, pose.orientation}});
  }
  return result;
}

}  // namespace tangent
