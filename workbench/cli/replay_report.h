// Reports of replay: on standard output, and as JSON.
#pragma once

#include "workbench/recording/compare.h"
#include "workbench/recording/replay.h"

#include <nlohmann/json_fwd.hpp>

namespace tangent {

void print_replay(const ReplayReport& report, const RecordingInfo& info, double seconds);
nlohmann::ordered_json replay_json(const ReplayReport& report, const RecordingInfo& info);

void print_comparison(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace tangent
