// Screenshots of the whole window, with the session stepped in simulated time.
#pragma once

#include "workbench/gui/platform/shots.h"

#include <cstdint>

namespace tangent {

const std::vector<ShotView>& window_shot_views();
/// Precondition: the view is one of window_shot_views().
Result<Shot> take_window_shot(const ShotRequest& request);

/// Whether the exploration before a picture goes on after `done` ticks: for 12 s, and for 12 s more where the contact
/// has been in view (`seen`) but isn't now. Where it never was, as on a plate, it will not be.
bool explores_on(std::uint64_t done, bool seen, bool in_view);

}  // namespace tangent
