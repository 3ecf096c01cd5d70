// The plots as a figure for a paper: what they show, on white, with axes and names of their own.
#pragma once

#include "workbench/gui/panels/panels.h"
#include "workbench/session/figure_table.h"

namespace tangent {

/// The mode that is shown, over the ticks in view. Curves of more ticks than a page has room for as the least and
/// largest value of each part of them. Fails where there is nothing to draw.
Result<Figure> plot_figure(const PlotsPanel& state, const TimeModel& time);

}  // namespace tangent
