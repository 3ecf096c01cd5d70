#include "workbench/recording/computable_recording.h"

namespace tangent {

Result<RecordedScenes> scenes_of(Recording& recording, const std::shared_ptr<const ContactScene>& given) {
  RecordedScenes scenes;
  for (const RecordedScene& recorded : recording.scenes()) {
    if (given && scene_hash(*given) == recorded.hash) {
      scenes[recorded.id] = given;
      continue;
    }
    if (given && !recorded.has_bytes) return tl::unexpected(recording.is_scene(recorded, *given).error());
    Result<std::shared_ptr<const ContactScene>> scene = recording.scene(recorded.id);
    if (!scene) return tl::unexpected(scene.error());
    scenes[recorded.id] = std::move(*scene);
  }
  return scenes;
}

Result<std::vector<KeptState>> usable_states(Recording& recording) {
  const RecordingInfo& info = recording.info();
  if (!info.states_usable)
    return fail("was made by version " + info.version + ", whose kept states this version can't use",
                recording.path().string(),
                "compare with replay --preset or --method, which compute the motion from its beginning");
  Result<std::vector<KeptState>> states = recording.states();
  if (states && info.ticks > 0 && (states->empty() || states->front().tick != info.first_tick))
    return fail("has no kept state of its first tick", recording.path().string(),
                "the file is damaged: copy it from where it was recorded again");
  return states;
}

Result<ComputableRecording> open_computable(const std::filesystem::path& path,
                                            const std::shared_ptr<const ContactScene>& given) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  Result<std::vector<KeptState>> states = usable_states(*recording);
  if (!states) return tl::unexpected(states.error());
  Result<RecordedScenes> scenes = scenes_of(*recording, given);
  if (!scenes) return tl::unexpected(scenes.error());
  return ComputableRecording{std::move(*recording), std::move(*states), std::move(*scenes)};
}

}  // namespace tangent
