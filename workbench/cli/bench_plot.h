// The work-precision plot: time per tick against the contact's error over a range of tolerances, log-log, one panel per
// scene, one curve per method.
#pragma once

#include "workbench/bench/scene_report.h"
#include "workbench/session/figure_table.h"

#include <span>

namespace tangent::bench {

/// Points with more than 1 % of their ticks unconverged are left out. Errors below 1e-9 um are drawn at 1e-9 um.
Figure work_precision_figure(std::span<const WorkPrecisionReport> panels);

}  // namespace tangent::bench
