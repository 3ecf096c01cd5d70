// A recording in the place of the live past.
#include "workbench/gui/model/time_model.h"

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
  if (const std::string problem = recording_->take_problem(); !problem.empty()) messages_.say(Severity::error, problem);
  update_axis();
}

void TimeModel::show_page() {
  past_.show_page(recording_->page());
  error_fan_.clear();
  open_time_machine();
  if (!(presets_.current() == paused_with_)) preset_sent();
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
  messages_.say(Severity::note,
                "this is the mesh of " + recording_->path().filename().string() + ": its ticks can be solved again");
  if (cursor_) recording_->see_tick(*cursor_);
  show_page();
  tick_.clear();
  show_tick();
}

}  // namespace tangent
