// The work-precision plot as an SVG file: time per tick against the contact's error as the tolerance sweeps, log-log,
// one panel a scene, one curve a method. Colours by Okabe & Ito, which differ for the colour-blind too.
#pragma once

#include "workbench/bench/scene_report.h"

#include <span>
#include <string>

namespace tangent::bench {

/// Points with more than 1 % of their ticks unconverged are left out. Errors below 1e-9 um are drawn there.
std::string work_precision_svg(std::span<const WorkPrecisionReport> panels);

}  // namespace tangent::bench
