#include "workbench/gui/model/record_model.h"

#include "workbench/gui/model/local_time.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <system_error>
#include <utility>

namespace tangent {

namespace {

std::string text_of_bytes(const std::filesystem::path& file) {
  std::error_code failed;
  const auto bytes = std::filesystem::file_size(file, failed);
  char text[40];
  std::snprintf(text, sizeof text, "%.1f MB", failed ? 0.0 : static_cast<double>(bytes) / 1e6);
  return text;
}

RecordedEvent event_of(const Bookmark& mark, bool removed) {
  return {mark.tick, mark.t_s, removed ? "unbookmark" : "bookmark", mark.note};
}

/// What happened in the past, as a recorder would have noted it.
std::vector<RecordedEvent> events_of(const Session& session, const Bookmarks& bookmarks,
                                     const HistorySnapshot& records) {
  std::vector<RecordedEvent> events = safety_events(session.safety_log());
  for (const Bookmark& mark : bookmarks.all())
    if (mark.kind == BookmarkKind::user) events.push_back(event_of(mark, false));
  for (std::size_t i = 1; i < records.size(); ++i) {
    const TickRecord& tick = records[i].tick;
    if (tick.preset_id != records[i - 1].tick.preset_id)
      events.push_back({tick.tick, tick.input.t_s, "preset", "preset " + std::to_string(tick.preset_id)});
  }
  std::stable_sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.tick < b.tick; });
  return events;
}

}  // namespace

RecordModel::RecordModel(const AppOptions& options, DeviceModel& devices, const SceneModel& scene,
                         const TimeModel& time, MessageLog& messages)
    : options_(options),
      devices_(devices),
      scene_(scene),
      time_(time),
      messages_(messages),
      folder_(options.screenshots.empty() ? std::filesystem::path(".") : options.screenshots),
      wish_(!options.record.empty()) {
  devices_.before_release([this] {
    stop();
    scenes_.clear();
  });
}

RecordModel::~RecordModel() {
  stop();
  devices_.before_release({});
}

/// A name that is free, unless one is given.
std::filesystem::path RecordModel::named(std::filesystem::path file, const char* stem) const {
  if (!file.empty()) return file;
  const std::string name = std::string(stem) + "-" + local_time("%Y%m%d-%H%M%S");
  std::error_code ignored;
  for (int i = 1;; ++i) {
    file = folder_ / (name + (i > 1 ? "-" + std::to_string(i) : "") + ".sqlite");
    if (!std::filesystem::exists(file, ignored)) return file;
  }
}

void RecordModel::start(std::filesystem::path file) {
  if (recorder_ != nullptr) return messages_.say(Severity::note, "is being recorded to " + file_.string());
  Session* session = devices_.session();
  if (session == nullptr) return messages_.say(Severity::error, "there is no session to record");
  const std::filesystem::path to = named(std::move(file), "recording");
  know_scene();
  const StretchScene known = scenes_[session->status().scene_sent];
  auto started = SessionRecorder::start(*session, to, {known.source, known.name, !options_.deterministic});
  if (!started) return messages_.say(Severity::error, "not recorded: " + started.error().message());
  recorder_ = std::move(*started);
  file_ = std::filesystem::absolute(to).lexically_normal();
  told_.clear();
  marks_.clear();
  for (const Bookmark& mark : time_.live_bookmarks().all()) marks_[mark.id] = mark;  // of ticks before it
  messages_.say(Severity::note, "recording to " + file_.string());
}

void RecordModel::stop() {
  if (recorder_ == nullptr) return;
  note_bookmarks();
  const Status done = recorder_->finish();
  last_ = recorder_->status();
  recorder_.reset();
  const std::string numbers = std::to_string(last_.written) + " ticks, " + std::to_string(last_.missing) +
                              " missing, " + text_of_bytes(file_) + " in " + file_.string();
  if (done)
    messages_.say(last_.missing > 0 ? Severity::warning : Severity::note, "recorded: " + numbers);
  else
    messages_.say(Severity::error, done.error().message());
}

void RecordModel::note_bookmarks() {
  const std::vector<Bookmark>& all = time_.live_bookmarks().all();
  for (const Bookmark& mark : all) {
    if (mark.kind != BookmarkKind::user) continue;
    const auto known = marks_.find(mark.id);
    if (known != marks_.end() && known->second.note == mark.note) continue;
    marks_[mark.id] = mark;
    recorder_->add_event(event_of(mark, false));
  }
  std::erase_if(marks_, [&](const auto& known) {
    if (time_.live_bookmarks().find(known.first) != nullptr) return false;
    if (known.second.kind == BookmarkKind::user) recorder_->add_event(event_of(known.second, true));
    return true;
  });
}

void RecordModel::say_trouble() {
  const std::string now = recorder_->status().trouble;
  if (now == told_) return;
  told_ = now;
  messages_.say(
      now.empty() ? Severity::note : Severity::error,
      now.empty() ? "the recording goes on" : "not recorded at present, and tried again every second: " + now);
}

void RecordModel::update() {
  take_written();
  if (wish_ && devices_.session() != nullptr) {
    wish_ = false;
    start(options_.record);
  }
  if (recorder_ == nullptr) return;
  note_bookmarks();
  recorder_->poll();
  say_trouble();
}

/// What the session's scene was built from.
void RecordModel::know_scene() {
  const Session& session = *devices_.session();
  const std::uint32_t id = session.status().scene_sent;
  if (scenes_.contains(id) || scene_.of_servo() != session.scene()) return;
  std::erase_if(scenes_, [&](const auto& known) { return !session.scenes().contains(known.first); });
  scenes_[id] = {std::filesystem::path(scene_.of_servo()->mesh().name()).filename().string(), scene_.source()};
}

void RecordModel::scene_changed() {
  if (devices_.session() == nullptr) return;
  know_scene();
  if (recorder_ == nullptr) return;
  const std::uint32_t id = devices_.session()->status().scene_sent;
  recorder_->scene_changed(id, scene_.of_servo(), scenes_[id].name, scenes_[id].source);
}

// --- What is in the history ----------------------------------------------------------------------------

void RecordModel::write_history(std::filesystem::path file) {
  const Session* session = devices_.session();
  if (session == nullptr || session->history().empty()) return messages_.refuse("there is no tick to record yet");
  write_stretch_to(named(std::move(file), "history"),
                   {session->history().oldest().tick.tick, session->history().newest().tick.tick});
}

void RecordModel::write_selection(std::filesystem::path file) {
  if (time_.recording() != nullptr)
    return messages_.refuse("these ticks are recorded already: `workbench export` takes a part of a file");
  if (!time_.selection()) return messages_.refuse("set cursors A and B first: Ctrl-click and Shift-click in a plot");
  write_stretch_to(named(std::move(file), "selection"), *time_.selection());
}

void RecordModel::write_stretch_to(const std::filesystem::path& file, const TickRange& range) {
  if (writing()) return messages_.refuse("a recording is being written; try again when it is done");
  const PastPart* part = time_.recording() == nullptr ? time_.past().part_with(range) : nullptr;
  know_scene();
  const Session& session = *devices_.session();
  RecordedStretch stretch{session.recorded_run(), scenes_, {}, session_values(session)};
  if (part != nullptr) {
    stretch.run.records = part->records;
    stretch.run.scenes = part->scenes;
  }
  HistorySnapshot& records = stretch.run.records;
  records = records.slice(records.lower_bound(range.from), records.lower_bound(range.to + 1));
  if (records.empty()) return messages_.refuse("the ticks between the cursors are no longer kept");
  stretch.events = events_of(session, time_.live_bookmarks(), records);
  auto work = [stretch = std::move(stretch), file]() -> Result<std::string> {
    if (const Status done = write_stretch(stretch, file); !done) return tl::unexpected(done.error());
    return std::to_string(stretch.run.records.size()) + " ticks, " + text_of_bytes(file) + " in " +
           std::filesystem::absolute(file).lexically_normal().string();
  };
  writing_ = std::async(options_.deterministic ? std::launch::deferred : std::launch::async, std::move(work));
  if (options_.deterministic) writing_.wait();
  take_written();
}

void RecordModel::take_written() {
  if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Result<std::string> done = writing_.get();
  if (done)
    messages_.say(Severity::note, "recorded: " + *done);
  else
    messages_.say(Severity::error, "not recorded: " + done.error().message());
}

}  // namespace tangent
