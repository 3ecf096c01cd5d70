// An explained tick as JSON.
#pragma once

#include "workbench/recording/explain_recording.h"

#include <nlohmann/json_fwd.hpp>

namespace tangent {

nlohmann::ordered_json explained_tick_json(const ExplainedTick& explained);
nlohmann::ordered_json explained_recording_json(const ExplainedRecording& explained);

}  // namespace tangent
