// Reports of replay: on standard output, and as JSON.
#pragma once

#include "workbench/recording/compare.h"
#include "workbench/recording/replay.h"

#include <nlohmann/json_fwd.hpp>

namespace tangent {

/// `every_second`: the ticks with a kept state alone were computed, so that no kept state was led to.
void print_replay(const ReplayReport& report, const RecordingInfo& info, double seconds, bool every_second);
nlohmann::ordered_json replay_json(const ReplayReport& report, const RecordingInfo& info);

void print_comparison(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace tangent
