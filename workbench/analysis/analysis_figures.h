// The figures of an analysis, drawn by gnuplot (workbench/session/figure_table.h). One of a simulated group says so.
#pragma once

#include "workbench/analysis/comparison_results.h"
#include "workbench/analysis/naming_results.h"
#include "workbench/session/figure_table.h"

namespace tangent::analysis {

/// Segments by trial of a participant's staircases, side by side (Doxon et al., Fig. 10). `staircases`: of one
/// participant, at least one.
Figure staircases_figure(std::span<const StaircaseResult> staircases, const std::string& name, bool simulated);

/// Thresholds with their intervals beside the paper's (Fig. 11), in segments.
Figure thresholds_figure(const ComparisonResults& results, bool simulated);

/// Right answers to each object, beside the paper's (Fig. 12), percent.
Figure accuracy_figure(const NamingResults& results, bool simulated);
/// Time from the first touch to a right answer (Fig. 13).
Figure times_figure(const NamingResults& results, bool simulated);
/// Share of the time in contact, shaded and not (Fig. 14).
Figure contact_figure(const NamingResults& results, bool simulated);

}  // namespace tangent::analysis
