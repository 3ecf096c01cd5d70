// The work-precision plot as SVG: time per tick against the contact's error over a range of tolerances, log-log, one
// panel per scene, one curve per method. Colour-blind safe palette of Okabe & Ito.
#pragma once

#include "workbench/bench/scene_report.h"

#include <span>
#include <string>

namespace tangent::bench {

/// Points with more than 1 % of their ticks unconverged are left out. Errors below 1e-9 um are drawn at 1e-9 um.
std::string work_precision_svg(std::span<const WorkPrecisionReport> panels);

}  // namespace tangent::bench
