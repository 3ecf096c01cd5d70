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

}  // namespace

TimeModel::TimeModel(const AppOptions& options, DeviceModel& devices, const PresetModel& presets, MessageLog& messages)
    : devices_(devices),
      presets_(presets),
      messages_(messages),
      solved_bytes_(options.solved_bytes),
      threaded_(!options.deterministic),
      store_(kChannelCount, plotted_ticks(options.history_s, options.servo_hz)),
      time_machine_(options.deterministic ? 0u : std::max(1u, std::thread::hardware_concurrency())) {}

double TimeModel::tick_period_s() const {
  if (recording_) return recording_->tick_period_s();
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
  const ChannelStore& all = store();
  axis_.update(all.first_tick(), all.end_tick(),
               static_cast<double>(std::max<std::uint64_t>(all.capacity(), all.end_tick() - all.first_tick())));
}

void TimeModel::take_records() {
  if (recording_) take_page();
  if (devices_.session() == nullptr) return;
  devices_.session()->poll();
  if (recording_) return;
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
  if (placed_) {
    const Session* session = devices_.session();
    const ServoRecord record =
        session != nullptr ? placed_->record(cursor_.value_or(0), session->preset_id(), session->status().scene_sent)
                           : placed_->record(cursor_.value_or(0), 0, 0);
    tick_.show(record, [this](const ServoRecord&, IterationTrace& trace) -> Result<TickOutput> {
      return placed_->solve(placed_->preset(), trace);
    });
  } else {
    const ServoRecord* record = !paused_ || !cursor_ ? &records().newest() : records().find(*cursor_);
    if (record == nullptr) return;
    const auto solve = [this](const ServoRecord& of, IterationTrace& trace) -> Result<TickOutput> {
      if (const std::string why = recording_ ? recording_->unsolvable() : std::string(); !why.empty()) return fail(why);
      return past_.re_step(of, preset(of.tick.preset_id), trace);
    };
    tick_.show(*record, solve);
    error_fan_.show(past_, record->tick.tick, solve);
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
  if (recording_) {
    cancel_loading();
    if (past_.kept_selection() != nullptr) {
      past_.drop_selection();
      show_page();
    }
  } else {
    past_.keep(bookmarks_, selection_);
  }
  if (time_machine_.ghost() != nullptr) request_comparison();
}

void TimeModel::forget() {
  if (recording_) {  // what is in view stays; the live past of the new run begins when it is closed
    live_past_.forget();
    store_.clear();
    bookmarks_.clear_automatic();
    parameter_marks_.clear();
    last_preset_id_.reset();
    return;
  }
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
    if (recording_) return messages_.refuse("a recording is open: End closes it and goes back to live");
    go_live();
    return;
  }
  paused_ = true;
  axis_.hold();
  past_.freeze();
  bookmarks_.hold = true;
  if (const ServoRecord* record = tick_.record()) cursor_ = record->tick.tick;
  paused_with_ = in_force_.value_or(presets_.current());
  open_time_machine();
}

/// On the part in view, frozen; of a recording on the selection where it was read.
void TimeModel::open_time_machine() {
  compared_by_hand_.reset();
  if (records().empty() || (recording_ && !recording_->unsolvable().empty())) return time_machine_.close();
  time_machine_.open(run_of(part_to_solve()));
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
  if (recording_) {
    asked_.reset();
    solve_when_read_.reset();
    recording_.reset();
    past_ = std::move(live_past_);
    live_past_ = {};
    selection_.reset();
    tick_.clear();
    beside_.clear();
    error_fan_.clear();
  }
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
  if (records().empty() && !recording_) return;
  set_paused(true);
  forget_place();
  if (recording_ && recording_->see_tick(tick)) show_page();
  if (records().empty()) return messages_.refuse("no tick was recorded there");
  if (const PastPart* was = &past_.shown(); past_.show(tick) && &past_.shown() != was) show_part();
  const std::size_t at = std::min(records().lower_bound(tick), records().size() - 1);
  cursor_ = records()[at].tick.tick;
  axis_.reveal(static_cast<double>(*cursor_));
  show_tick();
}

void TimeModel::step_tick(std::int64_t by) {
  if (recording_ && cursor_ && recording_->see_tick(*cursor_)) show_page();  // the plots may have gone elsewhere
  if (records().empty()) return;
  set_paused(true);
  const std::size_t now =
      std::min(records().lower_bound(cursor_.value_or(records().newest().tick.tick)), records().size() - 1);
  const auto last = static_cast<std::int64_t>(records().size()) - 1;
  const std::int64_t wish = static_cast<std::int64_t>(now) + by;
  if (recording_ && (wish < 0 || wish > last)) {  // beyond the page
    const auto tick = static_cast<std::int64_t>(records()[now].tick.tick) + by;
    return select_tick(std::clamp(static_cast<std::uint64_t>(std::max<std::int64_t>(0, tick)),
                                  recording_->info().first_tick, recording_->info().last_tick));
  }
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
  if (placed_) return messages_.refuse("a tick solved at a place has no time that could be bookmarked");
  bookmarks().add(record->tick.tick, record->tick.input.t_s);
}

void TimeModel::go_to_bookmark(int by) {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  const std::uint64_t now = record->tick.tick;
  const Bookmark* to = by > 0 ? bookmarks().after(now) : bookmarks().before(now);
  // A bookmark of an earlier run has no tick.
  while (to != nullptr && !reaches(to->tick)) to = by > 0 ? bookmarks().after(to->tick) : bookmarks().before(to->tick);
  if (to == nullptr)
    messages_.refuse(by > 0 ? "no later bookmark" : "no earlier bookmark");
  else
    select_tick(to->tick);
}

}  // namespace tangent
