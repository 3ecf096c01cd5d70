// The model's time: records coming in, the tick in view, bookmarks, and the past solved again.
#include "workbench/gui/model/app_model.h"

#include "workbench/gui/model/export_samples.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace tangent {

namespace {

constexpr std::size_t kMostParameterMarks = 2000;

float event_of(const ServoRecord& r) {
  const auto rank = [](EventRank e) { return static_cast<float>(e); };
  if (r.device.gate_fault != GateFault::none || r.device.force_fault != DeviceFault::none ||
      r.device.display_fault != DeviceFault::none)
    return rank(EventRank::fault);
  if (r.tick.output.status == TickStatus::unconverged) return rank(EventRank::unconverged);
  switch (r.tick.output.event) {
    case TickEvent::reseed:
      return rank(EventRank::reseeded);
    case TickEvent::switched:
    case TickEvent::branch:
      return rank(EventRank::moved);
    default:
      return std::nanf("");
  }
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

double AppModel::tick_period_s() const { return session_ != nullptr ? 1.0 / session_->options().servo.rate_hz : 1e-3; }

void AppModel::take_records() {
  take_export();
  if (session_ == nullptr) return;
  session_->poll();
  const History& history = session_->history();
  if (!history.empty()) {
    // A history whose newest tick lies before ours is another run.
    const std::uint64_t next =
        history.newest().tick.tick < store_.end_tick() && history.newest().tick.tick + 1 != store_.end_tick()
            ? history.oldest().tick.tick
            : store_.end_tick();
    std::array<float, kChannelCount> row{};
    for (std::size_t i = history.lower_bound(next); i < history.size(); ++i) {
      const ServoRecord& r = history[i];
      const Vec3& f = r.device.force_command_n;
      // In simulated time nothing is measured: a gap rather than a zero.
      const float tick_time = r.tick_ns > 0.0 ? static_cast<float>(r.tick_ns * 1e-9) : std::nanf("");
      row = {static_cast<float>(f.x),
             static_cast<float>(f.y),
             static_cast<float>(f.z),
             static_cast<float>(glm::length(f)),
             static_cast<float>(r.device.cld_command_m),
             static_cast<float>(r.device.cld_measured_m),
             static_cast<float>(r.tick.output.error_m),
             static_cast<float>(r.tick.output.iterations),
             tick_time,
             event_of(r)};
      store_.push(r.tick.tick, row);
      bookmarks_.watch(r);
      mark_parameters(r);
    }
    bookmarks_.forget_before(history.oldest().tick.tick);
  }
  status_ = session_->status();
  if (status_.servo.gate_fault != last_gate_fault_ && status_.servo.gate_fault != GateFault::none) {
    say(Severity::error, std::string("force stopped: ") + to_string(status_.servo.gate_fault) + "; press Arm to go on");
  }
  last_gate_fault_ = status_.servo.gate_fault;
  if (status_.force_fault != last_fault_ && status_.force_fault != DeviceFault::none) {
    say(Severity::error, std::string("force device: ") + to_string(status_.force_fault));
  }
  last_fault_ = status_.force_fault;
  axis_.update(store_.first_tick(), store_.end_tick(), static_cast<double>(store_.capacity()));
}

void AppModel::show_tick() {
  if (session_ == nullptr || session_->history().empty()) return;
  const History& history = session_->history();
  const ServoRecord* record = !paused_ || !cursor_ ? &history.newest() : history.find(*cursor_);
  if (record == nullptr) return;
  tick_.show(*session_, *record);
  error_fan_.show(*session_, record->tick.tick);
}

void AppModel::set_paused(bool paused) {
  if (paused == paused_) return;
  if (!paused) {
    go_live();
    return;
  }
  paused_ = true;
  axis_.hold();
  if (const ServoRecord* record = tick_.record()) cursor_ = record->tick.tick;
  paused_with_ = presets().current();
  if (session_ != nullptr && !session_->history().empty()) time_machine_.open(session_->recorded_run());
}

void AppModel::go_live() {
  paused_ = false;
  cursor_.reset();
  time_machine_.close();
  axis_.follow();
  axis_.update(store_.first_tick(), store_.end_tick(), static_cast<double>(store_.capacity()));
  show_tick();
}

void AppModel::select_tick(std::uint64_t tick) {
  if (session_ == nullptr || session_->history().empty()) return;
  set_paused(true);
  const History& history = session_->history();
  const std::size_t at = std::min(history.lower_bound(tick), history.size() - 1);
  cursor_ = history[at].tick.tick;
  axis_.reveal(static_cast<double>(*cursor_));
  show_tick();
}

void AppModel::step_tick(std::int64_t by) {
  if (session_ == nullptr || session_->history().empty()) return;
  set_paused(true);
  const History& history = session_->history();
  const std::size_t now =
      std::min(history.lower_bound(cursor_.value_or(history.newest().tick.tick)), history.size() - 1);
  const auto last = static_cast<std::int64_t>(history.size()) - 1;
  const std::int64_t to = std::clamp(static_cast<std::int64_t>(now) + by, std::int64_t{0}, last);
  select_tick(history[static_cast<std::size_t>(to)].tick.tick);
}

void AppModel::step_iteration(int by) {
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
  if (cursor_.value_or(0) == before) return;  // there is no further tick
  if (!tick_.iterations().empty()) tick_.select(by > 0 ? 0 : tick_.iterations().size() - 1);
}

void AppModel::mark_parameters(const ServoRecord& record) {
  const std::uint32_t id = record.tick.preset_id;
  if (last_preset_id_ && *last_preset_id_ != id) {
    const Preset* before = session_->preset(*last_preset_id_);
    const Preset* now = session_->preset(id);
    if (before != nullptr && now != nullptr) {
      if (parameter_marks_.size() == kMostParameterMarks) parameter_marks_.erase(parameter_marks_.begin());
      parameter_marks_.push_back({record.tick.tick, change_text(*before, *now)});
    }
  }
  last_preset_id_ = id;
}

std::size_t AppModel::history_bytes() const { return session_ != nullptr ? session_->history().memory_bytes() : 0; }
std::size_t AppModel::most_history_bytes() const {
  return session_ != nullptr ? session_->history().most_memory_bytes() : 0;
}

void AppModel::add_bookmark() {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  bookmarks_.add(record->tick.tick, record->tick.input.t_s);
}

void AppModel::go_to_bookmark(int by) {
  const ServoRecord* record = tick_.record();
  if (record == nullptr) return;
  const std::uint64_t now = record->tick.tick;
  const Bookmark* to = by > 0 ? bookmarks_.after(now) : bookmarks_.before(now);
  // A person's bookmark outlives its tick.
  if (to == nullptr || to->tick < first_tick())
    say(Severity::note, by > 0 ? "no later bookmark" : "no earlier bookmark");
  else
    select_tick(to->tick);
}

void AppModel::ask_for_ghost() {
  if (!paused_ || !time_machine_.is_open()) return;
  if (presets().current() == paused_with_)
    time_machine_.forget_request();
  else
    time_machine_.request(presets().current(), axis_.from(), axis_.to());
}

std::filesystem::path AppModel::free_path(const std::string& stem, const char* extension) const {
  for (int i = 1;; ++i) {
    std::filesystem::path path = export_folder_ / (stem + (i > 1 ? "-" + std::to_string(i) : "") + extension);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return path;
  }
}

void AppModel::export_ticks(std::uint64_t from, std::uint64_t to) {
  if (session_ == nullptr || exporting()) return;
  const auto path = free_path("ticks-" + std::to_string(from) + "-" + std::to_string(to > 0 ? to - 1 : 0), ".csv");
  auto work = [records = session_->history().snapshot(), from, to, path]() -> Result<std::string> {
    const auto lines = export_samples(records, from, to, path);
    if (!lines) return tl::unexpected(lines.error());
    return std::to_string(*lines) + " ticks written to " + std::filesystem::absolute(path).string();
  };
  exporting_ = std::async(options_.deterministic ? std::launch::deferred : std::launch::async, std::move(work));
  if (options_.deterministic) exporting_.wait();
  take_export();
}

void AppModel::take_export() {
  if (!exporting_.valid() || exporting_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Result<std::string> done = exporting_.get();
  if (done)
    say(Severity::note, *done);
  else
    say(Severity::error, done.error().message());
}

void AppModel::ask_for_picture(const std::string& what, const Rect& of) {
  picture_request_ = PictureRequest{free_path(what, ".png"), of};
}

void AppModel::solve_past_again() {
  set_paused(true);
  time_machine_.request(presets().current(), axis_.from(), axis_.to());
}

}  // namespace tangent
