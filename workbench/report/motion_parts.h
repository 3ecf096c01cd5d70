// The motion of a recording as every method can solve it.
#pragma once

#include "workbench/bench/compare_methods.h"
#include "workbench/report/tick_before.h"

namespace tangent {

/// All ticks, or, of more than `most`, 20 stretches of them that lie evenly over the recording. A new part begins where
/// scene or preset changes and after a gap.
Result<std::vector<bench::MotionPart>> motion_parts(Recording& recording, const RecordedScenes& scenes,
                                                    std::uint64_t most);

}  // namespace tangent
