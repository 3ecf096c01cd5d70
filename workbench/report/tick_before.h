// One recorded tick with the state that it was given.
#pragma once

#include "workbench/recording/computable_recording.h"

namespace tangent {

struct TickBefore {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  TickRecord tick;  ///< `kept`: the state before it
};

/// Solves from the last kept state on. Fails where the recording has none for it, or its ticks can't be read.
Result<TickBefore> tick_before(Recording& recording, const RecordedScenes& scenes, std::uint64_t tick);

}  // namespace tangent
