// A recording in the place of the live past.
#include "workbench/gui/model/time_model.h"

#include <algorithm>
#include <utility>

namespace tangent {

void TimeModel::show(std::unique_ptr<OpenedRecording> recording) {
  go_live();
  recording_ = std::move(recording);
  paused_ = true;
  selection_.reset();
  placed_.reset();
  live_past_ = std::move(past_);
  past_ = {};
  past_.show_page(recording_->page());
  cursor_ = records().oldest().tick.tick;
  paused_with_ = preset(records().oldest().tick.preset_id) != nullptr ? *preset(records().oldest().tick.preset_id)
                                                                      : presets_.current();
  tick_.clear();
  beside_.clear();
  error_fan_.clear();
  live_beside_.clear();
  update_axis();
  axis_.show_all();
  for (const std::string& remark : recording_->remarks()) messages_.say(Severity::warning, remark);
  if (const std::string why = recording_->unsolvable(); !why.empty()) messages_.say(Severity::warning, why);
  open_time_machine();
  if (!(presets_.current() == paused_with_)) preset_sent();
  show_tick();
}

/// Once a frame.
void TimeModel::take_page() {
  recording_->see_range(axis_.from(), axis_.to());
  if (recording_->update()) show_page();
  take_selection();
  if (const std::string problem = recording_->take_problem(); !problem.empty()) messages_.say(Severity::error, problem);
  update_axis();
}

void TimeModel::show_page() {
  past_.show_page(recording_->page());
  error_fan_.clear();
  if (past_.kept_selection() != nullptr && time_machine_.is_open()) return;  // what is solved stays as it is
  open_time_machine();
  if (!(presets_.current() == paused_with_)) preset_sent();
}

// --- From A to B -------------------------------------------------------------------------------------------

const PastPart& TimeModel::part_to_solve() const {
  const PastPart* selected = recording_ ? past_.kept_selection() : nullptr;
  return selected != nullptr ? *selected : past_.shown();
}

bool TimeModel::load_selection() {
  if (!recording_ || !selection_ || selection_kept()) return true;
  if (selection_loading()) return false;
  if (const std::string why = recording_->unsolvable(); !why.empty()) {
    messages_.say(Severity::note, "not solved again: " + why);
    return false;
  }
  const RecordingInfo& info = recording_->info();
  const std::uint64_t from = std::clamp(selection_->from, info.first_tick, info.last_tick);
  const std::uint64_t to = std::clamp(selection_->to, from, info.last_tick);
  const std::uint64_t lead_in = std::min(from - info.first_tick, RecordedPast::kLeadIn);
  asked_ = std::make_unique<AskedRange>(recording_->path(), recording_->scenes(), solved_bytes_, threaded_);
  if (const Status began = asked_->load({from - lead_in, to}); !began) {
    messages_.say(Severity::error, began.error().message());
    return false;
  }
  if (!threaded_) take_selection();
  return selection_kept();
}

void TimeModel::cancel_loading() {
  asked_.reset();
  solve_when_read_.reset();
}

void TimeModel::take_selection() {
  auto read = asked_ ? asked_->take() : std::nullopt;
  if (!read) return;
  const auto under = std::exchange(solve_when_read_, std::nullopt);
  if (!*read) return messages_.say(Severity::error, read->error().message());
  if ((*read)->records.empty()) return messages_.say(Severity::note, "no tick was recorded from A to B");
  past_.keep_selection(*selection_, std::move(**read));
  const auto by_hand = compared_by_hand_;
  open_time_machine();
  compared_by_hand_ = by_hand;
  if (under)
    solve_again(*under);
  else if (!(presets_.current() == paused_with_))
    preset_sent();
}

void TimeModel::take_bookmarks(const std::vector<UnsavedBookmark>& marks) {
  const std::vector<Bookmark> before = bookmarks().all();
  for (const Bookmark& mark : before)
    if (mark.kind == BookmarkKind::user) bookmarks().remove(mark.id);
  for (const UnsavedBookmark& mark : marks) bookmarks().set_note(bookmarks().add(mark.tick, mark.t_s), mark.note);
}

bool TimeModel::reaches(std::uint64_t tick) const {
  if (recording_) return recording_->info().first_tick <= tick && tick <= recording_->info().last_tick;
  return past_.reaches(tick);
}

void TimeModel::offer_scene(const std::shared_ptr<const ContactScene>& scene) {
  if (!recording_ || !recording_->offer_scene(scene)) return;
  cancel_loading();
  messages_.say(Severity::note,
                "this is the mesh of " + recording_->path().filename().string() + ": its ticks can be solved again");
  if (cursor_) recording_->see_tick(*cursor_);
  show_page();
  tick_.clear();
  show_tick();
}

}  // namespace tangent
