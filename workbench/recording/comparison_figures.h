// Curves of what was compared, as figures: both side by side, and their difference below.
#pragma once

#include "workbench/recording/compare_recordings.h"
#include "workbench/session/figure_table.h"

namespace tangent {

/// "comparison-force", "comparison-display" and "comparison-solver"; "comparison-spectrum" of a second or more.
/// `seconds_per_tick`: of the time axis. Least and most of each part of the ticks; of the difference the most.
std::vector<Figure> comparison_figures(const RecordingsCompared& compared, double seconds_per_tick);

}  // namespace tangent
