// Screenshots of the whole window, with the session stepped in simulated time.
#pragma once

#include "workbench/gui/platform/shots.h"

namespace tangent {

const std::vector<ShotView>& window_shot_views();
/// Precondition: the view is one of window_shot_views().
Result<Image> take_window_shot(const ShotRequest& request);

}  // namespace tangent
