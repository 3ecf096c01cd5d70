// A recording's ticks, one after the other, computed again with the state that each was given.
#pragma once

#include "workbench/recording/replay.h"

namespace tangent {

using RecordedScenes = std::map<std::uint32_t, std::shared_ptr<const ContactScene>>;

class TickWalk {
 public:
  /// From the kept state `begin` of `states` on, to the tick `last`. All must outlive it.
  static Result<TickWalk> start(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                                std::size_t begin, std::uint64_t last);

  /// Goes on to the next tick and computes it. False: there is none. Fails as replay does.
  Result<bool> next();

  /// The tick as it was recorded, with the state that it was given.
  const RecordedTick& tick() const { return tick_; }
  const TickOutput& output() const { return output_; }  ///< as computed here
  bool follows() const { return follows_; }             ///< the tick before is the one that was computed before
  const Preset& preset() const { return *preset_; }
  const std::shared_ptr<const ContactScene>& scene() const { return scene_; }

 private:
  TickWalk(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states, std::size_t begin,
           TickReader reader)
      : recording_(&recording), scenes_(&scenes), states_(states), next_state_(begin), reader_(std::move(reader)) {}
  Status enter_scene();

  Recording* recording_;
  const RecordedScenes* scenes_;
  std::span<const KeptState> states_;
  std::size_t next_state_;
  TickReader reader_;
  RecordedTick tick_;
  TickOutput output_;
  bool follows_ = false;
  std::uint64_t expected_ = 0;  ///< number of the tick that would follow; 0: none was computed yet
  const Preset* preset_ = nullptr;
  std::shared_ptr<const ContactScene> scene_;
  std::optional<Stepper> stepper_;
  TickState state_;
};

/// What one tick was given. `scenes` as of scenes_of. Fails where the recording has no such tick.
Result<TickWalk> walk_to(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                         std::uint64_t tick);

/// The kept states of a recording. Fails where they are of another layout, or none is of the first tick.
Result<std::vector<KeptState>> usable_states(Recording& recording);

}  // namespace tangent
