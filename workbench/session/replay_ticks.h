// Solves consecutive recorded ticks again, one by one.
#pragma once

#include "core/tick/render_again.h"
#include "workbench/session/session.h"

#include <algorithm>
#include <optional>

namespace tangent {

/// Carries state and stepper from one tick to the next, as the servo does. It takes the recorded state at the first
/// tick, and again wherever ticks are missing or the scene changed.
class ReplayTicks {
 public:
  /// `wish`: the preset of every tick; null: each under its own. `take_over`: where `wish` changes no value that the
  /// solver reads, the recorded contact is taken over; otherwise every tick is solved. Both must outlive it.
  ReplayTicks(const RecordedRun& run, const Preset* wish, bool take_over = true)
      : run_(run), wish_(wish), take_over_(take_over) {}

  /// Solves the tick again; empty when its scene or preset is gone. `taken_over`: its contact is the recorded one.
  std::optional<TickOutput> step(const ServoRecord& record, bool& taken_over, IterationTrace* trace = nullptr) {
    const TickRecord& tick = record.tick;
    enter_scene(record);
    const bool follows =
        before_ != nullptr && record.scene_id == before_->scene_id && tick.tick == before_->tick.tick + 1;
    if (!follows) {
      as_recorded_ = true;
      rendered_ = tick.kept.rendered;
    }
    const bool changed = follows && wish_ == nullptr && tick.preset_id != before_->tick.preset_id;
    if (changed) {  // as the servo did
      begin_change(rendered_);
      begin_change(state_.rendered);
    }
    before_ = &record;
    taken_over = false;
    if (!stepper_ || preset(record) == nullptr) {
      as_recorded_ = true;
      return std::nullopt;
    }
    const bool alike = wish_ != nullptr && same_contacts_as(recorded_preset(record));
    if (take_over_ && trace == nullptr && alike && as_recorded_ && is_converged(tick.output.status)) {
      taken_over = true;
      return render_again(stepper_->scene(), *wish_, tick.input, tick.kept, rendered_, tick.output);
    }
    if (as_recorded_) {
      state_ = tick.kept;
      state_.rendered = rendered_;
    }
    as_recorded_ = as_recorded_ && alike;
    const TickOutput out = stepper_->step(*preset(record), tick.input, state_, trace);
    rendered_ = state_.rendered;
    return out;
  }

  double tolerance_m(const ServoRecord& record) const {
    const Preset* recorded = recorded_preset(record);
    const double own = preset(record)->solver.tolerance_m;
    return recorded != nullptr ? std::max(own, recorded->solver.tolerance_m) : own;
  }

 private:
  const Preset* recorded_preset(const ServoRecord& record) const {
    return record.tick.preset_id < run_.presets.size() ? &run_.presets[record.tick.preset_id] : nullptr;
  }
  const Preset* preset(const ServoRecord& record) const { return wish_ != nullptr ? wish_ : recorded_preset(record); }

  void enter_scene(const ServoRecord& record) {
    if (before_ != nullptr && record.scene_id == before_->scene_id) return;
    const auto scene = run_.scenes.find(record.scene_id);
    stepper_.reset();
    if (scene != run_.scenes.end()) stepper_.emplace(scene->second);
  }

  bool same_contacts_as(const Preset* recorded) {
    if (recorded != compared_) {
      compared_ = recorded;
      alike_ = recorded != nullptr && same_contacts(*wish_, *recorded);
    }
    return alike_;
  }

  const RecordedRun& run_;
  const Preset* wish_;  ///< null: each tick under its recorded preset
  bool take_over_;
  std::optional<Stepper> stepper_;  ///< none: the scene is gone
  const ServoRecord* before_ = nullptr;
  TickState state_;
  RenderedState rendered_;            ///< of the previous tick, as solved here
  bool as_recorded_ = true;           ///< the next tick starts from the recorded state, not from `state_`
  const Preset* compared_ = nullptr;  ///< recorded preset for which `alike_` was computed
  bool alike_ = false;
};

}  // namespace tangent
