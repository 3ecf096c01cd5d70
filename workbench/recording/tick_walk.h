// A recording's ticks, one after the other, computed again with the state that each was given.
#pragma once

#include "workbench/recording/computable_recording.h"

#include <span>

namespace tangent {

class TickWalk {
 public:
  /// From the kept state `begin` of `states` on, to the tick `last`. All must outlive it.
  static Result<TickWalk> start(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                                std::size_t begin, std::uint64_t last);
  /// From the kept state before `first` on, or, without one, from `first` on. Ticks that can't be computed (their scene
  /// is not there, or no state leads to them) are no failure: `computed` says which are.
  static Result<TickWalk> start_tolerant(Recording& recording, const RecordedScenes& scenes,
                                         std::span<const KeptState> states, std::uint64_t first, std::uint64_t last);

  /// Goes on to the next tick and computes it. False: there is none. Fails as replay does.
  Result<bool> next();

  /// The tick as it was recorded, with the state that it was given.
  const RecordedTick& tick() const { return tick_; }
  bool computed() const { return computed_; }           ///< else neither the state nor what follows is known
  const TickOutput& output() const { return output_; }  ///< as computed here
  bool follows() const { return follows_; }             ///< the tick before is the one that was computed before
  const Preset& preset() const { return *preset_; }
  const std::shared_ptr<const ContactScene>& scene() const { return scene_; }

 private:
  TickWalk(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states, std::size_t begin,
           TickReader reader)
      : recording_(&recording), scenes_(&scenes), states_(states), next_state_(begin), reader_(std::move(reader)) {}
  bool enter_scene();
  Result<bool> take_state();
  Status not_computed(const std::string& why);

  Recording* recording_;
  const RecordedScenes* scenes_;
  std::span<const KeptState> states_;
  std::size_t next_state_;
  TickReader reader_;
  bool tolerant_ = false;
  RecordedTick tick_;
  TickOutput output_;
  bool computed_ = false, follows_ = false;
  std::optional<std::uint64_t> expected_;  ///< the tick that state_ is handed to; none: it is of no use
  const Preset* preset_ = nullptr;
  std::shared_ptr<const ContactScene> scene_;
  std::optional<Stepper> stepper_;
  TickState state_;
};

/// What one tick was given. `scenes` as of scenes_of. Fails where the recording has no such tick.
Result<TickWalk> walk_to(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                         std::uint64_t tick);

}  // namespace tangent
