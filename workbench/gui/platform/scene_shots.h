// Screenshots of the 3D view only: objects, control net, planes, surfaces.
#pragma once

#include "workbench/gui/platform/shots.h"

namespace tangent {

const std::vector<ShotView>& scene_shot_views();
/// Precondition: the view is one of scene_shot_views().
Result<Shot> take_scene_shot(const ShotRequest& request);

}  // namespace tangent
