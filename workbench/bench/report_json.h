// The benchmark's report as JSON. Every key of a measured quantity ends in its unit; shares and ratios have none.
#pragma once

#include "workbench/bench/scene_report.h"

#include <nlohmann/json.hpp>

namespace tangent::bench {

nlohmann::ordered_json report_json(const BenchReport& report);

/// Typical tick, less the clock's overhead, as a multiple of one evaluation, and of a typical tick of `paper`; 0 where
/// that was not measured.
double ticks_per_evaluation(const SceneReport& scene, const MethodReport& method);
double ticks_per_paper_tick(const SceneReport& scene, const MethodReport& method);

/// Mean tick in mean times of Embree's query bounded by the last nearest triangle, in the same run; 0 without.
double mean_per_bounded_query(const SceneReport& scene, const MethodReport& method);

}  // namespace tangent::bench
