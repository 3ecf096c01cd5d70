#include "workbench/gui/model/unsaved_model.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr double kEvery_s = 2.0;

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::filesystem::path folder_beside(const std::filesystem::path& settings) {
  return settings.empty() ? settings : settings.parent_path() / "unsaved";
}

}  // namespace

UnsavedModel::UnsavedModel(const AppOptions& options, PresetModel& presets, TimeModel& time, MessageLog& messages)
    : presets_(presets), time_(time), messages_(messages), folder_(folder_beside(options.settings)), keeper_(folder_) {
  std::vector<UnreadWork> unread;
  left_ = find_left_work(folder_, &unread);
  for (const UnreadWork& work : unread)
    messages_.say(Severity::warning, work.file.string() + ": unsaved work of an earlier run that can't be read" +
                                         (work.aside.empty() ? "" : " (it is kept as " + work.aside.string() + ")"));
}

UnsavedModel::~UnsavedModel() {
  if (!would_be_lost()) return;
  keep();
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

void UnsavedModel::keep() {
  UnsavedWork work;
  presets_.slots().put_into(work);
  for (const Bookmark& mark : time_.live_bookmarks().all()) {
    if (mark.kind == BookmarkKind::user) work.bookmarks.push_back({mark.tick, mark.t_s, mark.note});
  }
  if (const Status kept = keeper_.keep(work); !kept) messages_.say(Severity::warning, kept.error().message());
}

std::string UnsavedModel::offer() const {
  if (!left_) return {};
  std::string text = "An earlier run ended with unsaved work: ";
  const std::size_t changes = left_->work.steps.empty() ? 0 : left_->work.steps.size() - 1;
  if (changes > 0) text += counted(changes, "change of presets", "changes of presets");
  if (changes > 0 && !left_->work.bookmarks.empty()) text += " and ";
  if (!left_->work.bookmarks.empty()) text += counted(left_->work.bookmarks.size(), "bookmark", "bookmarks");
  return text;
}

void UnsavedModel::take_up() {
  if (!left_) return;
  if (left_->work.steps.size() > 1) presets_.take_up(left_->work);
  for (const UnsavedBookmark& mark : left_->work.bookmarks) {
    const std::uint32_t id = time_.live_bookmarks().add(mark.tick, mark.t_s);
    time_.live_bookmarks().set_note(id, "earlier run: " + mark.note);
  }
  keep();
  discard();
}

void UnsavedModel::discard() {
  if (left_) forget_left_work(*left_);
  left_.reset();
}

}  // namespace tangent
