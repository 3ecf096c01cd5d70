// Speed against error drawn: time over error, both logarithmic, a curve a method. A click on a point opens the worst
// tick behind it.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/widgets/ui_context.h"

namespace tangent {

/// The colour and marker of a method here.
ImU32 method_ink(const UiContext& ui, Method method);
void draw_method_marker(const UiContext& ui, Method method, ImVec2 at, float size);

/// Opens the worst tick behind a point (from 0, peers after them), its planes drawn.
void open_curve_point(AppModel& model, std::size_t i);

void draw_curves_plot(const UiContext& ui, AppModel& model, const bench::SpeedCurves& curves);

}  // namespace tangent
