#include "workbench/gui/model/tuning_model.h"

#include <algorithm>
#include <thread>
#include <utility>

namespace tangent {

namespace {

constexpr std::size_t kMostPoints = 40'000;

/// The preset with every swept key at its default: what has to be equal for points to belong together.
Preset without(Preset preset, const std::array<TuningModel::Axis, 2>& axes) {
  for (const TuningModel::Axis& axis : axes) {
    if (axis.key != nullptr) axis.key->set(preset, axis.key->default_value());
  }
  return preset;
}

unsigned worker_threads() { return std::clamp(std::thread::hardware_concurrency(), 2u, 5u) - 1; }

}  // namespace

TuningModel::TuningModel(const AppOptions& options, PresetModel& presets, TimeModel& time, MessageLog& messages)
    : presets_(presets), time_(time), messages_(messages), deterministic_(options.deterministic) {
  set_key(0, find_preset_key("solver", "gain_curvature_m"));
  axes_[1].count = 9;
}

std::vector<const PresetKey*> TuningModel::keys_to_sweep() const {
  std::vector<const PresetKey*> keys;
  for (const PresetKey& key : preset_keys()) {
    if (key.kind != KeyKind::choice && key.read_by.has(presets_.current().solver.method)) keys.push_back(&key);
  }
  return keys;
}

void TuningModel::set_key(std::size_t axis, const PresetKey* key) {
  if (axes_[axis].key == key) return;
  sweep_.cancel();
  points_.clear();
  axes_[axis].key = key;
  if (key == nullptr) return;
  axes_[axis].from = key->slider_min;
  axes_[axis].to = key->slider_max;
}

void TuningModel::set_range(std::size_t axis, double from, double to) {
  const PresetKey* key = axes_[axis].key;
  if (key == nullptr) return;
  axes_[axis].from = std::clamp(from, key->min, key->max);
  axes_[axis].to = std::clamp(to, key->min, key->max);
}

void TuningModel::set_count(std::size_t axis, std::size_t count) {
  axes_[axis].count = std::clamp<std::size_t>(count, 2, 100);
}

SweepPlan TuningModel::plan() const {
  SweepPlan plan{presets_.current(), {}};
  for (const Axis& axis : axes_) {
    if (axis.key != nullptr) plan.axes.push_back(sweep_axis(*axis.key, axis.from, axis.to, axis.count));
  }
  return plan;
}

void TuningModel::cancel_sweep() {
  if (waits()) time_.cancel_loading();
  waits_ = Waits::none;
  sweep_.cancel();
}

/// Those of a recording from A to B are read first, where they are not.
bool TuningModel::ticks_are_there(Waits otherwise) {
  if (time_.load_selection()) return true;
  waits_ = time_.selection_loading() ? otherwise : Waits::none;
  return false;
}

void TuningModel::start_sweep() {
  if (!ticks_are_there(Waits::sweep)) return;
  const auto range = time_.chosen_range();
  auto part = range ? time_.run_over(*range) : std::nullopt;
  if (!part) return messages_.say(Severity::note, "no ticks to sweep over yet");
  const Preset base = without(presets_.current(), axes_);
  if (!(points_range_ == *range) || !(points_base_ == base)) points_.clear();
  points_range_ = *range;
  points_base_ = base;
  sweep_.start(std::move(*part), plan(), deterministic_ ? 0 : worker_threads());
  update();
}

void TuningModel::update() {
  if (waits() && !time_.selection_loading()) {
    const Waits waited = std::exchange(waits_, Waits::none);
    if (time_.selection_kept()) waited == Waits::sweep ? start_sweep() : search_gains();
  }
  for (SweepPoint& point : sweep_.take()) add(std::move(point), false);
  const auto compared = time_.time_machine().compared();
  if (compared == seen_) return;
  seen_ = compared;
  const bool same = compared != nullptr && !points_.empty() && compared->from_tick == points_range_.from &&
                    compared->end_tick == points_range_.to + 1 && without(compared->after, axes_) == points_base_;
  if (!same) return;
  SweepPoint point{{}, compared->after_numbers};
  for (const Axis& axis : axes_) {
    if (axis.key != nullptr) point.values.push_back(axis.key->get(compared->after));
  }
  add(std::move(point), true);
}

void TuningModel::add(SweepPoint point, bool by_hand) {
  const auto at = std::lower_bound(points_.begin(), points_.end(), point.values,
                                   [](const Point& p, const std::vector<double>& v) { return p.point.values < v; });
  if (at != points_.end() && at->point.values == point.values) {
    at->point = std::move(point);
    return;
  }
  if (points_.size() < kMostPoints) points_.insert(at, {std::move(point), by_hand});
}

bool TuningModel::outdated() const { return !points_.empty() && !(without(presets_.current(), axes_) == points_base_); }

void TuningModel::try_point(std::size_t i) {
  if (i >= points_.size()) return;
  std::vector<std::pair<const PresetKey*, double>> values;
  for (const Axis& axis : axes_) {
    if (axis.key != nullptr) values.emplace_back(axis.key, points_[i].point.values[values.size()]);
  }
  presets_.set_values("a swept point", values);
}

std::optional<GainAdvice> TuningModel::advice_here() {
  const ServoRecord* record = time_.tick().record();
  const auto scene = time_.scene_of_tick();
  if (record == nullptr || scene == nullptr || scene->planar() != nullptr) return std::nullopt;
  const TickOutput& out = record->tick.output;
  const Preset& preset = presets_.current();
  const AdviceFor asked{record->tick.tick, record->tick.input.t_s, out.u,         out.v,         out.triangle,
                        scene.get(),       preset.solver,          preset.finger, time_.paused()};
  if (!(advised_for_ == asked)) {
    advice_ = advise_gains(scene->mesh(), preset, out, asked.walk);
    advised_for_ = asked;
  }
  return advice_.local ? std::optional(advice_) : std::nullopt;
}

void TuningModel::search_gains() {
  if (!ticks_are_there(Waits::search)) return;
  const auto range = time_.chosen_range();
  const auto part = range ? time_.run_over(*range) : std::nullopt;
  if (!part) return messages_.say(Severity::note, "no ticks to search over yet");
  const HistorySnapshot& records = part->run.records;
  const std::uint32_t scene_id = records.newest().scene_id;
  const auto scene = part->run.scenes.find(scene_id);
  if (scene == part->run.scenes.end() || scene->second->planar() != nullptr) return;
  std::vector<TickInput> poses;
  for (std::size_t i = part->first; i < records.size(); ++i) {
    if (records[i].scene_id == scene_id) poses.push_back(records[i].tick.input);
  }
  searched_selection_ = time_.selection();
  search_.start(scene->second, presets_.current(), std::move(poses), records.newest().tick.tick, !deterministic_);
}

std::shared_ptr<const GainSearchResult> TuningModel::found() const {
  const auto result = search_.result();
  if (result == nullptr || !(searched_selection_ == time_.selection())) return nullptr;
  Preset now = presets_.current();
  const Gains gains = gains_of(now.solver);
  now.solver = with_gains(now.solver, gains_of(result->base.solver));
  if (!same_for_solver(now, result->base)) return nullptr;
  return gains == gains_of(result->base.solver) || gains == result->best.gains ? result : nullptr;
}

void TuningModel::set_gains(const Gains& gains) {
  const std::array<std::pair<const PresetKey*, double>, 3> values{
      {{find_preset_key("solver", "gain_overall"), gains.overall},
       {find_preset_key("solver", "gain_curvature_m"), gains.curvature_m},
       {find_preset_key("solver", "gain_distance_per_m"), gains.distance_per_m}}};
  presets_.set_values("advised gains", values);
}

}  // namespace tangent
