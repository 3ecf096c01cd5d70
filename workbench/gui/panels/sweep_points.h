// The points of a sweep: a curve of means, 99th percentiles and failures over one key, or a field of means over two. A
// click on a point tries its values.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/widgets/ui_context.h"

#include <string>
#include <vector>

namespace tangent {

/// Precondition: there are points.
void draw_sweep_points(const UiContext& ui, AppModel& model);
/// Over two keys. Precondition: two are chosen.
void draw_sweep_field(const UiContext& ui, AppModel& model);

/// The numbers of a point, for its tooltip.
std::string sweep_point_text(const TuningModel& tuning, const TuningModel::Point& point);
/// The place under the pointer, or near it; `by_column`: whatever its height. places.size(): none.
std::size_t nearest_sweep_point(const UiContext& ui, const std::vector<ImVec2>& places, bool by_column);
void note_sweep_points(const UiContext& ui, const std::vector<ImVec2>& places);

}  // namespace tangent
