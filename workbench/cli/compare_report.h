// What `workbench compare` prints.
#pragma once

#include "workbench/recording/compare_recordings.h"

#include <nlohmann/json_fwd.hpp>

namespace tangent {

void print_compared(const RecordingsCompared& compared, double seconds);
nlohmann::ordered_json compared_json(const RecordingsCompared& compared);

}  // namespace tangent
