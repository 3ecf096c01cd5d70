// The benchmark's report as text: one line per method.
#pragma once

#include "workbench/bench/scene_report.h"
#include "workbench/bench/speed_curves.h"

#include <string>

namespace tangent::bench {

std::string report_legend(const BenchReport& report);
std::string scene_text(const SceneReport& scene);
/// Over all scenes: ticks that failed, scaling with mesh size, ratios.
std::string summary_text(const BenchReport& report);

/// A line a point and peer, then which method is the fastest for an error, and which are ties.
std::string curves_text(const SpeedCurves& curves);

}  // namespace tangent::bench
