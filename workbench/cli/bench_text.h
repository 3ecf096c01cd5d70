// The benchmark's report for people: one line a method.
#pragma once

#include "workbench/bench/scene_report.h"

#include <string>

namespace tangent::bench {

std::string report_legend(const BenchReport& report);
std::string scene_text(const SceneReport& scene);
/// Over all scenes: what was missed, the flatness in size, the ratios.
std::string summary_text(const BenchReport& report);

}  // namespace tangent::bench
