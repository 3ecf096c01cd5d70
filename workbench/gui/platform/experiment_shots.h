// Pictures of both screens of an experiment, half way through a shipped protocol: a simulated hand goes over the
// stimuli, and keys are pressed as a participant would.
#pragma once

#include "workbench/gui/platform/shots.h"

namespace tangent {

const std::vector<ShotView>& experiment_shot_views();
/// Precondition: the view is one of these.
Result<Shot> take_experiment_shot(const ShotRequest& request);

}  // namespace tangent
