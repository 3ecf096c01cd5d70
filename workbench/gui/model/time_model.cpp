#include "workbench/gui/model/time_model.h"

#include <algorithm>
#include <thread>

namespace tangent {

namespace {

constexpr std::size_t kMostParameterMarks = 2000;

/// Number of ticks that the session's history keeps.
std::size_t plotted_ticks(double history_s, double servo_hz) {
  return static_cast<std::size_t>(
      std::min(history_s * servo_hz, static_cast<double>(kLargestHistoryBytes / sizeof(ServoRecord))));
}

std::string change_text(const Preset& before, const Preset& now) {
  std::string text;
  std::size_t more = 0;
  for (const PresetKey& key : preset_keys()) {
    const double was = key.get(before), is = key.get(now);
    if (was == is) continue;
    if (!text.empty()) {
      ++more;
      continue;
    }
    const std::string unit(display_unit(key).name);
    text = std::string(key.label) + " " + display_text(key, was) + " \u2192 " + display_text(key, is) +
           (unit.empty() ? "" : " " + unit);
  }
  if (more > 0) text += " and " + std::to_string(more) + " more";
  return text;
}

}  // namespace

TimeModel::TimeModel(const AppOptions& options, DeviceModel& devices, const PresetModel& presets, MessageLog& messages)
    : devices_(devices),
      presets_(presets),
      messages_(messages),
      store_(kChannelCount, plotted_ticks(options.history_s, options.servo_hz)),
      time_machine_(options.deterministic ? 0u : std::max(1u, std::thread::hardware_concurrency())) {}

double TimeModel::tick_period_s() const {
  const Session* session = devices_.session();
  return session != nullptr ? 1.0 / session->options().servo.rate_hz : 1e-3;
}

std::size_t TimeModel::history_bytes() const {
  const Session* session = devices_.session();
  return session != nullptr ? session->history().memory_bytes() : 0;
}

std::size_t TimeModel::most_history_bytes() const {
  const Session* session = devices_.session();
  return session != nullptr ? session->history().most_memory_bytes() : 0;
}

void TimeModel::update_axis() {
  axis_.update(store().first_tick(), store().end_tick(), static_cast<double>(store().capacity()));
}

void TimeModel::take_records() {
  if (devices_.session() == nullptr) return;
  devices_.session()->poll();
  past_.follow(*devices_.session());
  take_in();
  const PresetSlots& slots = presets_.slots();
  if (!other_slot_beside)
    live_beside_.clear();
  else if (!paused_)
    live_beside_.take(past_.main(), slots.slot(1 - slots.active_slot()).current(), store_.capacity());
  update_axis();
}

/// Plots, marks and triggers take in what the past has since the last call, and drop what it has no longer.
void TimeModel::take_in() {
  const HistorySnapshot& all = past_.main().records;
  if (!all.empty()) {
    // A history whose newest tick is before ours belongs to a new run.
    const std::uint64_t newest = all.newest().tick.tick, oldest = all.oldest().tick.tick, end = store_.end_tick();
    const std::uint64_t next = newest < end && newest + 1 != end ? oldest : end;
    for (std::size_t i = all.lower_bound(next); i < all.size(); ++i) {
      const ServoRecord& record = all[i];
      store_.push(record.tick.tick, channel_row(record));
      bookmarks_.watch(record);
      mark_parameters(record);
    }
    store_.drop_before(oldest);
    bookmarks_.forget_before(oldest);
  }
  past_.keep(bookmarks_, selection_);
}

void TimeModel::mark_parameters(const ServoRecord& record) {
  const std::uint32_t id = record.tick.preset_id;
  if (last_preset_id_ && *last_preset_id_ != id) {
    const Preset* before = devices_.session()->preset(*last_preset_id_);
    const Preset* now = devices_.session()->preset(id);
    if (before != nullptr && now != nullptr) {
      if (parameter_marks_.size() == kMostParameterMarks) parameter_marks_.erase(parameter_marks_.begin());
      parameter_marks_.push_back({record.tick.tick, change_text(*before, *now)});
    }
  }
  last_preset_id_ = id;
}

void TimeModel::show_tick() {
  if (records().empty()) return;
  const Session& session = *devices_.session();
  if (placed_) {
    const ServoRecord record = placed_->record(cursor_.value_or(0), session.preset_id(), session.status().scene_sent);
    tick_.show(record, [this](const ServoRecord&, IterationTrace& trace) -> Result<TickOutput> {
      return placed_->solve(placed_->preset(), trace);
    });
  } else {
    const ServoRecord* record = !paused_ || !cursor_ ? &records().newest() : records().find(*cursor_);
    if (record == nullptr) return;
    tick_.show(*record, [&](const ServoRecord& of, IterationTrace& trace) {
      return past_.re_step(session, of, nullptr, trace);
    });
    error_fan_.show(session, past_, record->tick.tick);
  }
  show_beside();
}

std::size_t TimeModel::frozen_bytes() const {
  return devices_.session() != nullptr ? past_.extra_bytes(*devices_.session()) : 0;
}

std::uint64_t TimeModel::newest_recorded() const {
  const Session* session = devices_.session();
  return session != nullptr && !session->history().empty() ? session->history().newest().tick.tick : 0;
}

void TimeModel::set_selection(const std::optional<TickRange>& range) {
  if (range == selection_) return;
  selection_ = range;
  past_.keep(bookmarks_, selection_);
  if (time_machine_.ghost() != nullptr) request_comparison();
}

void TimeModel::forget() {
  store_.clear();
  bookmarks_.clear_automatic();
  parameter_marks_.clear();
  last_preset_id_.reset();
  past_.forget();
  live_beside_.clear();
  selection_.reset();
  kept_store_.reset();
  placed_.reset();
  tick_.clear();
  beside_.clear();
  error_fan_.clear();
  go_live();
}

void TimeModel::set_paused(bool paused) {
  if (paused == paused_) return;
  if (!paused) {
    go_live();
    return;
  }
  paused_ = true;
  axis_.hold();
  past_.freeze();
  bookmarks_.hold = true;
  if (const ServoRecord* record = tick_.record()) cursor_ = record->tick.tick;
  paused_with_ = presets_.current();
  open_time_machine();
}

/// On the part in view, frozen.
void TimeModel::open_time_machine() {
  compared_by_hand_.reset();
  if (records().empty()) return time_machine_.close();
  RecordedRun run = devices_.session()->recorded_run();
  run.records = records();
  run.scenes = past_.shown().scenes;
  time_machine_.open(std::move(run));
}

/// Another part of the past has come into view.
void TimeModel::show_part() {
  kept_store_.reset();
  if (past_.shows_kept()) {
    kept_store_ = std::make_unique<ChannelStore>(kChannelCount, records().size());
    for (std::size_t i = 0; i < records().size(); ++i)
      kept_store_->push(records()[i].tick.tick, channel_row(records()[i]));
  }
  error_fan_.clear();
  update_axis();
  axis_.show_all();
  open_time_machine();
  if (!(presets_.current() == paused_with_)) preset_sent();
}

void TimeModel::go_live() {
  paused_ = false;
  cursor_.reset();
  forget_place();
  time_machine_.close();
  past_.thaw();
  bookmarks_.hold = false;
  kept_store_.reset();
  if (devices_.session() != nullptr) past_.follow(*devices_.session());
  take_in();
  axis_.follow();
  update_axis();
  show_tick();
}

void TimeModel::select_tick(std::uint64_t tick) {
  if (records().empty()) return;
  set_paused(true);
  forget_place();
  if (const PastPart* was = &past_.shown(); past_.show(tick) && &past_.shown() != was) show_part();
  const std::size_t at = std::min(records().lower_bound(tick), records().size() - 1);
  cursor_ = records()[at].tick.tick;
  axis_.reveal(static_cast<double>(*cursor_));
  show_tick();
}

void TimeModel::step_tick(std::int64_t by) {
  if (records().empty()) return;
  set_paused(true);
  const std::size_t now =
      std::min(records().lower_bound(cursor_.value_or(records().newest().tick.tick)), records().size() - 1);
  const auto last = static_cast<std::int64_t>(records().size()) - 1;
  const std::int64_t to = std::clamp(static_cast<std::int64_t>(now) + by, std::int64_t{0}, last);
  select_tick(records()[static_cast<std::size_t>(to)].tick.tick);
}

void TimeModel::step_iteration(int by) {
  set_paused(true);
  const std::size_t count = tick_.iterations().size();
  if (count == 0) return;
  const auto last = static_cast<std::int64_t>(count) - 1;
  const std::int64_t now = tick_.selected() ? static_cast<std::int64_t>(*tick_.selected()) : (by > 0 ? -1 : last + 1);
  const std::int64_t to = now + by;
  if (to >= 0 && to <= last) {
    tick_.select(static_cast<std::size_t>(to));
    return;
  }
  if (placed_) return;  // it has no tick before or after it
  const std::uint64_t before = cursor_.value_or(0);
  step_tick(by);
  if (cursor_.value_or(0) == before) return;  // no further tick
  if (!tick_.iterations().empty()) tick_.select(by > 0 ? 0 : tick_.iterations().size() - 1);
}

void TimeModel::add_bookmark() {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  if (placed_) return messages_.say(Severity::note, "a tick solved at a place has no time that could be bookmarked");
  bookmarks_.add(record->tick.tick, record->tick.input.t_s);
}

void TimeModel::go_to_bookmark(int by) {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  const std::uint64_t now = record->tick.tick;
  const Bookmark* to = by > 0 ? bookmarks_.after(now) : bookmarks_.before(now);
  // A bookmark of an earlier run has no tick.
  while (to != nullptr && !past_.reaches(to->tick))
    to = by > 0 ? bookmarks_.after(to->tick) : bookmarks_.before(to->tick);
  if (to == nullptr)
    messages_.say(Severity::note, by > 0 ? "no later bookmark" : "no earlier bookmark");
  else
    select_tick(to->tick);
}

}  // namespace tangent
