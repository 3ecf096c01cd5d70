// What computing a recording's ticks again needs: its scenes, built, and its kept states.
#pragma once

#include "workbench/recording/recording.h"

namespace tangent {

/// By id.
using RecordedScenes = std::map<std::uint32_t, std::shared_ptr<const ContactScene>>;

/// The scenes of a recording, by id, built or `given` for all of them that have its hash.
Result<RecordedScenes> scenes_of(Recording& recording, const std::shared_ptr<const ContactScene>& given);

/// The kept states of a recording. Fails where they are of another layout, or none is of the first tick.
Result<std::vector<KeptState>> usable_states(Recording& recording);

struct ComputableRecording {
  Recording recording;
  std::vector<KeptState> states;
  RecordedScenes scenes;
};
/// Fails as the above do. `given`: in place of the scenes in the file, for one that was recorded without them.
Result<ComputableRecording> open_computable(const std::filesystem::path& path,
                                            const std::shared_ptr<const ContactScene>& given);

}  // namespace tangent
