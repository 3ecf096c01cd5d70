// What TimeModel solves again: the tick in view under another preset or at a place, and ranges of ticks.
#include "workbench/gui/model/time_model.h"

namespace tangent {

const Preset* TimeModel::preset(std::uint32_t id) const {
  if (recording_) return recording_->preset(id);
  return devices_.session() != nullptr ? devices_.session()->preset(id) : nullptr;
}

const Preset* TimeModel::preset_of_tick() const {
  if (placed_) return &placed_->preset();
  const ServoRecord* record = tick_.record();
  return record != nullptr ? preset(record->tick.preset_id) : nullptr;
}

RecordedRun TimeModel::run_of(const PastPart& part) const {
  if (recording_) return {part.records, recording_->presets(), part.scenes};
  RecordedRun run = devices_.session()->recorded_run();
  run.records = part.records;
  run.scenes = part.scenes;
  return run;
}

std::shared_ptr<const ContactScene> TimeModel::scene_of_tick() const {
  if (placed_) return placed_->scene();
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return nullptr;
  const auto found = past_.shown().scenes.find(record->scene_id);
  return found != past_.shown().scenes.end() ? found->second : nullptr;
}

void TimeModel::show_beside() {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return beside_.clear();
  const std::uint64_t tick = record->tick.tick;
  const auto from_recorded = [&](const Preset& preset, IterationTrace& trace) -> std::optional<TickOutput> {
    if (placed_) return placed_->solve(preset, trace);
    const auto output = past_.re_step(*record, &preset, trace);
    return output ? std::optional(*output) : std::nullopt;
  };
  const PresetSlots& slots = presets_.slots();
  const std::shared_ptr<const Ghost> ghost = time_machine_.ghost();
  if (placed_) {
    if (presets_.current() == placed_->preset()) return beside_.clear();
    beside_.show(tick, presets_.current(), false, from_recorded);
  } else if (paused_ && ghost != nullptr && ghost->whole && time_machine_.run()->records.find(tick) != nullptr) {
    // As in the ghost, which carried its own contact along.
    beside_.show(tick, ghost->preset, true, [&](const Preset& preset, IterationTrace& trace) {
      const RecordedRun& run = *time_machine_.run();
      const std::size_t index = run.records.lower_bound(tick);
      return trace_resolved_tick(run, preset, index, trace);
    });
  } else if (paused_ && ghost != nullptr) {
    beside_.show(tick, ghost->preset, false, from_recorded);
  } else if (other_slot_beside && !paused_ && live_beside_.newest() == tick) {
    beside_.show(tick, slots.slot(1 - slots.active_slot()).current(), true, [&](const Preset&, IterationTrace& trace) {
      trace = live_beside_.trace();
      return std::optional(live_beside_.output());
    });
  } else if (other_slot_beside) {
    beside_.show(tick, slots.slot(1 - slots.active_slot()).current(), false, from_recorded);
  } else {
    beside_.clear();
  }
}

std::shared_ptr<const ChannelStore> TimeModel::ghost_channels() const {
  if (const auto ghost = time_machine_.ghost()) return ghost->channels;
  return other_slot_beside && !paused_ ? live_beside_.channels() : nullptr;
}

bool TimeModel::solve_at(const std::shared_ptr<const ContactScene>& scene, std::uint32_t triangle, double u, double v,
                         const MoveOptions& options) {
  auto placed = PlacedTick::at(scene, presets_.current(), triangle, u, v, options);
  if (!placed) {
    messages_.refuse("the finger can't rest on triangle " + std::to_string(triangle) +
                     ": the surface there is tighter than the finger, or the triangle is skipped");
    return false;
  }
  set_paused(true);
  tick_.clear();
  beside_.clear();
  error_fan_.clear();
  placed_ = std::move(placed);
  show_tick();
  return true;
}

void TimeModel::choose_move(std::size_t move) {
  if (!placed_) return;
  placed_->choose(move);
  tick_.clear();
  beside_.clear();
  show_tick();
}

void TimeModel::leave_place() {
  forget_place();
  show_tick();
}

void TimeModel::forget_place() {
  if (!placed_) return;
  placed_.reset();
  tick_.clear();
  beside_.clear();
  error_fan_.clear();
}

std::optional<TickRange> TimeModel::chosen_range() const {
  if (selection_kept()) return selection_;
  if (records().empty()) return std::nullopt;
  return TickRange{records().oldest().tick.tick, records().newest().tick.tick};
}

std::optional<RunPart> TimeModel::run_over(const TickRange& range) const {
  const PastPart* part = &past_.shown();
  if (!part->covers(range.from) || !part->covers(range.to)) part = past_.part_with(range);
  if (part == nullptr || (recording_ && !recording_->unsolvable().empty())) return std::nullopt;
  const RecordedRun run = run_of(*part);
  const std::size_t begin = run.records.lower_bound(range.from), end = run.records.lower_bound(range.to + 1);
  return begin < end ? std::optional(part_of(run, begin, end)) : std::nullopt;
}

void TimeModel::preset_sent() {
  if (placed_) show_tick();
  if (!paused_ || !time_machine_.is_open()) return;
  compared_by_hand_.reset();
  if (presets_.current() == paused_with_) {
    time_machine_.forget_request();
    return;
  }
  time_machine_.request(presets_.current(), axis_.from(), axis_.to());
  request_comparison();
}

void TimeModel::solve_past_again() {
  set_paused(true);
  compared_by_hand_.reset();
  solve_again(presets_.current());
}

void TimeModel::set_in_force(const Preset* in_force) {
  in_force_ = in_force != nullptr ? std::optional(*in_force) : std::nullopt;
}

/// What was asked for by hand; of a recording when the selection was read.
void TimeModel::solve_again(const Preset& under) {
  if (!load_selection()) {
    if (selection_loading()) solve_when_read_ = under;
    return;
  }
  time_machine_.request(under, axis_.from(), axis_.to());
  request_comparison();
}

void TimeModel::compare(const NamedPreset& before, const NamedPreset& after) {
  set_paused(true);
  compared_by_hand_ = {before, after};
  solve_again(after.preset);
}

void TimeModel::request_comparison() {
  if (records().empty() || !time_machine_.is_open()) return;
  const PastPart& part = part_to_solve();
  const bool selected =
      selection_ && ((part.covers(selection_->from) && part.covers(selection_->to)) || past_.kept_selection() == &part);
  const TickRange range =
      selected ? *selection_ : TickRange{part.records.oldest().tick.tick, part.records.newest().tick.tick};
  name_before_ = compared_by_hand_ ? compared_by_hand_->first.name : "at the pause";
  name_after_ = compared_by_hand_ ? compared_by_hand_->second.name : in_force_ ? "asked, not set" : "now";
  time_machine_.compare(compared_by_hand_ ? compared_by_hand_->first.preset : paused_with_,
                        compared_by_hand_ ? compared_by_hand_->second.preset : presets_.current(), range);
}

}  // namespace tangent
