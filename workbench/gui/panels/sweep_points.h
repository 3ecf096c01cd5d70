// The points of a sweep: a curve of means, 99th percentiles and failures over one key, or a field of means over two. A
// click on a point tries its values.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/widgets/ui_context.h"

namespace tangent {

/// Precondition: there are points.
void draw_sweep_points(const UiContext& ui, AppModel& model);

}  // namespace tangent
