#include "workbench/gui/model/unsaved_model.h"

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

namespace tangent {

namespace {

constexpr double kEvery_s = 2.0;

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::vector<UnsavedBookmark> by_person(const Bookmarks& bookmarks) {
  std::vector<UnsavedBookmark> marks;
  for (const Bookmark& mark : bookmarks.all())
    if (mark.kind == BookmarkKind::user) marks.push_back({mark.tick, mark.t_s, mark.note});
  return marks;
}

/// A recording that is gone is not offered.
void forget_what_is_gone(UnsavedWork& work) {
  std::error_code ignored;
  if (!std::filesystem::exists(work.opened.file, ignored)) work.opened = {};
  if (!std::filesystem::exists(work.made, ignored)) work.made.clear();
}

std::filesystem::path folder_beside(const std::filesystem::path& settings) {
  return settings.empty() ? settings : settings.parent_path() / "unsaved";
}

}  // namespace

UnsavedModel::UnsavedModel(const AppOptions& options, PresetModel& presets, TimeModel& time, const RecordModel& record,
                           MessageLog& messages, Reopen reopen)
    : presets_(presets),
      time_(time),
      record_(record),
      messages_(messages),
      reopen_(std::move(reopen)),
      folder_(folder_beside(options.settings)),
      keeper_(folder_) {
  std::vector<UnreadWork> unread;
  left_ = find_left_work(folder_, &unread);
  for (const UnreadWork& work : unread)
    messages_.say(Severity::warning, work.file.string() + ": unsaved work of an earlier run that can't be read" +
                                         (work.aside.empty() ? "" : " (it is kept as " + work.aside.string() + ")"));
  if (!left_) return;
  forget_what_is_gone(left_->work);
  if (left_->work.empty()) discard();
}

UnsavedModel::~UnsavedModel() {
  if (!would_be_lost()) return;
  UnsavedWork work = work_now();
  work.opened = {};  // closed in order
  work.made.clear();
  keep(work);
  keeper_.leave();
}

bool UnsavedModel::would_be_lost() const {
  const PresetSlots& slots = presets_.slots();
  const auto marks = time_.live_bookmarks().all();
  return slots.slot(0).changed() || slots.slot(1).changed() ||
         std::any_of(marks.begin(), marks.end(),
                     [](const Bookmark& mark) { return mark.kind == BookmarkKind::user && !mark.note.empty(); });
}

void UnsavedModel::update(double now_s) {
  if (now_s - looked_at_s_ < kEvery_s) return;
  looked_at_s_ = now_s;
  keep();
}

UnsavedWork UnsavedModel::work_now() const {
  UnsavedWork work;
  presets_.slots().put_into(work);
  work.bookmarks = by_person(time_.live_bookmarks());
  if (const OpenedRecording* recording = time_.recording()) {
    const ServoRecord* record = time_.tick().record();
    work.opened = {std::filesystem::absolute(recording->path()).lexically_normal(),
                   record != nullptr ? record->tick.tick : 0, by_person(recording->bookmarks())};
  }
  if (record_.recording()) work.made = record_.file();
  return work;
}

void UnsavedModel::keep() { keep(work_now()); }

void UnsavedModel::keep(const UnsavedWork& work) {
  if (const Status kept = keeper_.keep(work); !kept) messages_.say(Severity::warning, kept.error().message());
}

std::string UnsavedModel::offer() const {
  if (!left_) return {};
  const UnsavedWork& work = left_->work;
  std::vector<std::string> parts;
  if (work.steps.size() > 1) parts.push_back(counted(work.steps.size() - 1, "change of presets", "changes of presets"));
  if (!work.bookmarks.empty()) parts.push_back(counted(work.bookmarks.size(), "bookmark", "bookmarks"));
  if (!work.opened.file.empty())
    parts.push_back("the recording " + work.opened.file.filename().string() + " at tick " +
                    std::to_string(work.opened.tick));
  if (!work.made.empty()) parts.push_back("the recording that was being made, " + work.made.filename().string());
  std::string text = "An earlier run ended with unsaved work: ";
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

void UnsavedModel::take_up() {
  if (!left_) return;
  const UnsavedWork work = left_->work;
  if (work.steps.size() > 1) presets_.take_up(work);
  for (const UnsavedBookmark& mark : work.bookmarks) {
    const std::uint32_t id = time_.live_bookmarks().add(mark.tick, mark.t_s);
    time_.live_bookmarks().set_note(id, "earlier run: " + mark.note);
  }
  reopen(work);
  keep();
  discard();
}

/// The one that was looked at; else the one that was being made, at its end.
void UnsavedModel::reopen(const UnsavedWork& work) {
  if (!work.opened.file.empty()) {
    if (!work.made.empty()) messages_.say(Severity::note, "the other recording is " + work.made.string());
    return reopen_({work.opened.file, work.opened.tick}, work);
  }
  if (!work.made.empty()) reopen_({work.made, std::numeric_limits<std::uint64_t>::max()}, work);
}

void UnsavedModel::discard() {
  if (left_) forget_left_work(*left_);
  left_.reset();
}

}  // namespace tangent
