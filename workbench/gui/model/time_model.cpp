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

const History* TimeModel::history() const {
  const Session* session = devices_.session();
  return session == nullptr || session->history().empty() ? nullptr : &session->history();
}

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
  axis_.update(store_.first_tick(), store_.end_tick(), static_cast<double>(store_.capacity()));
}

void TimeModel::take_records() {
  if (devices_.session() == nullptr) return;
  devices_.session()->poll();
  if (const History* records = history()) {
    // A history whose newest tick is before ours belongs to a new run.
    const std::uint64_t newest = records->newest().tick.tick, end = store_.end_tick();
    const std::uint64_t next = newest < end && newest + 1 != end ? records->oldest().tick.tick : end;
    for (std::size_t i = records->lower_bound(next); i < records->size(); ++i) {
      const ServoRecord& record = (*records)[i];
      store_.push(record.tick.tick, channel_row(record));
      bookmarks_.watch(record);
      mark_parameters(record);
    }
    bookmarks_.forget_before(records->oldest().tick.tick);
  }
  update_axis();
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
  const History* records = history();
  if (records == nullptr) return;
  const ServoRecord* record = !paused_ || !cursor_ ? &records->newest() : records->find(*cursor_);
  if (record == nullptr) return;
  tick_.show(*devices_.session(), *record);
  error_fan_.show(*devices_.session(), record->tick.tick);
}

void TimeModel::forget() {
  store_.clear();
  bookmarks_.clear_automatic();
  parameter_marks_.clear();
  last_preset_id_.reset();
  tick_.clear();
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
  if (const ServoRecord* record = tick_.record()) cursor_ = record->tick.tick;
  paused_with_ = presets_.current();
  if (history() != nullptr) time_machine_.open(devices_.session()->recorded_run());
}

void TimeModel::go_live() {
  paused_ = false;
  cursor_.reset();
  time_machine_.close();
  axis_.follow();
  update_axis();
  show_tick();
}

void TimeModel::select_tick(std::uint64_t tick) {
  const History* records = history();
  if (records == nullptr) return;
  set_paused(true);
  const std::size_t at = std::min(records->lower_bound(tick), records->size() - 1);
  cursor_ = (*records)[at].tick.tick;
  axis_.reveal(static_cast<double>(*cursor_));
  show_tick();
}

void TimeModel::step_tick(std::int64_t by) {
  const History* records = history();
  if (records == nullptr) return;
  set_paused(true);
  const std::size_t now =
      std::min(records->lower_bound(cursor_.value_or(records->newest().tick.tick)), records->size() - 1);
  const auto last = static_cast<std::int64_t>(records->size()) - 1;
  const std::int64_t to = std::clamp(static_cast<std::int64_t>(now) + by, std::int64_t{0}, last);
  select_tick((*records)[static_cast<std::size_t>(to)].tick.tick);
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
  const std::uint64_t before = cursor_.value_or(0);
  step_tick(by);
  if (cursor_.value_or(0) == before) return;  // no further tick
  if (!tick_.iterations().empty()) tick_.select(by > 0 ? 0 : tick_.iterations().size() - 1);
}

void TimeModel::add_bookmark() {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  bookmarks_.add(record->tick.tick, record->tick.input.t_s);
}

void TimeModel::go_to_bookmark(int by) {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  const std::uint64_t now = record->tick.tick;
  const Bookmark* to = by > 0 ? bookmarks_.after(now) : bookmarks_.before(now);
  // A person's bookmark outlives its tick.
  if (to == nullptr || to->tick < first_tick())
    messages_.say(Severity::note, by > 0 ? "no later bookmark" : "no earlier bookmark");
  else
    select_tick(to->tick);
}

void TimeModel::preset_sent() {
  if (!paused_ || !time_machine_.is_open()) return;
  if (presets_.current() == paused_with_)
    time_machine_.forget_request();
  else
    time_machine_.request(presets_.current(), axis_.from(), axis_.to());
}

void TimeModel::solve_past_again() {
  set_paused(true);
  time_machine_.request(presets_.current(), axis_.from(), axis_.to());
}

}  // namespace tangent
