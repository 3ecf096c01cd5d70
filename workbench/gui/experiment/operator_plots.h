// The operator's curves: the force of the last seconds, and the staircase that runs now.
#pragma once

#include "workbench/gui/experiment/screens.h"
#include "workbench/gui/widgets/ui_context.h"

#include <imgui.h>

namespace tangent {

/// Newtons over seconds before now, with the limit: the protocol's, or the device's where that is lower.
void draw_force_trace(const UiContext& ui, const OperatorScreen& screen, ImVec2 at, ImVec2 size);
/// Segments over trials: right answers filled, wrong ones as crosses, reversals ringed.
void draw_staircase(const UiContext& ui, const OperatorScreen& screen, ImVec2 at, ImVec2 size);

}  // namespace tangent
