#include "workbench/session/exploration_poses.h"

#include "workbench/session/exploration_path.h"
#include "workbench/session/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

constexpr std::size_t kMostTicks = 100000;
constexpr double kPressShare = 0.05;  // of the mesh's longest side

/// 1 in the mean, by `share` more and less.
double swing(double way_m, double wave_m, double share) {
  return 1.0 + share * std::sin(2.0 * std::numbers::pi * way_m / wave_m);
}

template <class Path>
void follow(const Path& path, double pad_m, ExplorationPace pace, ExplorationPoses& explored) {
  const double varied = pace == ExplorationPace::varied ? 1.0 : 0.0;
  explored.length_m = path.length_m();
  double way = 0.0;
  while (way < explored.length_m && explored.poses.size() < kMostTicks) {
    const double press = explored.press_m * swing(way, kExplorationPressWave, varied * kExplorationPressSwing);
    const PathPose pose = path.at(way, pad_m, press);
    explored.poses.push_back(
        {kExplorationTick * static_cast<double>(explored.poses.size()), {pose.position_m, pose.orientation}});
    way += kExplorationTick * kExplorationSpeed * swing(way, kExplorationSpeedWave, varied * kExplorationSpeedSwing);
  }
  explored.way_m = std::min(way, explored.length_m);
}

}  // namespace

Result<ExplorationPoses> exploration_poses(const ContactScene& scene, const Finger& finger, ExplorationKind kind,
                                           ExplorationPace pace, double press_m) {
  ExplorationPoses explored;
  const double pad = pad_distance_m(finger);
  const Vec3 size = scene.mesh().bounds().size();
  explored.press_m = std::min(press_m, kPressShare * std::max({size.x, size.y, size.z}));
  if (kind == ExplorationKind::around) {
    follow(ExplorationPath::build(scene, pad), pad, pace, explored);
    return explored;
  }
  const Result<StrokePath> strokes = StrokePath::build(scene, pad);
  if (!strokes) return tl::unexpected(strokes.error());
  follow(*strokes, pad, pace, explored);
  return explored;
}

}  // namespace tangent
