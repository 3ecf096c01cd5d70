#include "workbench/gui/model/tuning_model.h"

#include "workbench/gui/model/coarse_first.h"
#include "workbench/gui/model/tune_question.h"
#include "workbench/session/background_thread.h"

#include <algorithm>
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

/// Its values, in order: those of a grid of the engine (workbench/sweep/plan.h).
std::vector<double> grid_of(const TuningModel::Axis& axis) {
  sweep::Range range;
  range.key = axis.key;
  range.from = axis.from;
  range.to = axis.to;
  range.count = axis.count;
  range.logarithmic = axis.key->logarithmic && axis.from > 0.0 && axis.to > 0.0;
  return range.grid();
}

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
  by_hand_.cancel();
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

Preset TuningModel::preset_at(const std::vector<double>& values) const {
  Preset out = presets_.current();
  std::size_t v = 0;
  for (const Axis& axis : axes_)
    if (axis.key != nullptr) axis.key->set(out, values[v++]);
  return out;
}

/// The motion of these ticks, on the mesh of the newest: from a fresh state, gaps taken as they come.
std::optional<sweep::Ground> TuningModel::ground_over(const TickRange& range) const {
  const auto part = time_.run_over(range);
  if (!part) return std::nullopt;
  const HistorySnapshot& records = part->run.records;
  const std::uint32_t id = records.newest().scene_id;
  const auto scene = part->run.scenes.find(id);
  if (scene == part->run.scenes.end()) return std::nullopt;
  auto motion = std::make_shared<std::vector<TickInput>>();
  for (std::size_t i = part->first; i < records.size(); ++i) {
    if (records[i].scene_id != id) continue;
    motion->push_back(records[i].tick.input);
    motion->back().unready = false;  // here everything is built
  }
  return sweep::Ground{scene->second, std::move(motion)};
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
  auto ground = range ? ground_over(*range) : std::nullopt;
  if (!ground) return messages_.refuse("no ticks to sweep over yet");
  const Preset base = without(presets_.current(), axes_);
  if (!(points_range_ == *range) || !(points_base_ == base)) points_.clear();
  points_range_ = *range;
  points_base_ = base;
  ground_ = std::move(ground);
  for (std::size_t a = 0; a < 2; ++a) grid_[a] = axes_[a].key != nullptr ? grid_of(axes_[a]) : std::vector<double>();
  planned_.clear();
  std::vector<Preset> presets;
  const std::size_t columns = grid_[0].size();
  for (const std::size_t cell : coarse_first(columns, std::max<std::size_t>(1, grid_[1].size()))) {
    std::vector<double> values{grid_[0][cell % columns]};
    if (!grid_[1].empty()) values.push_back(grid_[1][cell / columns]);
    presets.push_back(preset_at(values));
    planned_.push_back(std::move(values));
  }
  sweep_.start(*ground_, std::move(presets), deterministic_ ? 0 : background_threads());
  update();
}

void TuningModel::start_heat_map() {
  if (axes_[1].key == nullptr) {
    const auto keys = keys_to_sweep();
    const auto reads = [&](const PresetKey* key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
    const PresetKey *across = find_preset_key("solver", "gain_curvature_m"),
                    *up = find_preset_key("solver", "gain_distance_per_m");
    if (!reads(across) || !reads(up)) return messages_.refuse("this method has no gains: choose two values to sweep");
    set_key(0, across);
    set_key(1, up);
    // With what theory names in the middle (G_k) and at the lower end (G_d).
    const double reach = presets_.current().finger.reach_m(), length = reach > 0.0 ? reach : 0.01;
    set_range(0, 0.0, 2.0 * length);
    set_range(1, 0.0, 8.0 / length);
    set_count(0, 17);
    set_count(1, 17);
  }
  start_sweep();
}

std::optional<double> TuningModel::theory(std::size_t axis) const {
  return axes_[axis].key != nullptr ? theory_value(*axes_[axis].key, presets_.current().finger) : std::nullopt;
}

void TuningModel::update() {
  if (waits() && !time_.selection_loading()) {
    const Waits waited = std::exchange(waits_, Waits::none);
    if (time_.selection_kept()) waited == Waits::sweep ? start_sweep() : search_gains();
  }
  for (const sweep::PresetJob::Measured& done : sweep_.take()) add({planned_[done.index], done.numbers});
  take_by_hand();
  const auto compared = time_.time_machine().compared();
  if (compared == seen_) return;
  seen_ = compared;
  const bool same = compared != nullptr && !points_.empty() && ground_ && compared->from_tick == points_range_.from &&
                    compared->end_tick == points_range_.to + 1 && without(compared->after, axes_) == points_base_;
  if (!same) return;
  by_hand_values_.clear();
  for (const Axis& axis : axes_) {
    if (axis.key != nullptr) by_hand_values_.push_back(axis.key->get(compared->after));
  }
  by_hand_.start(*ground_, {compared->after}, deterministic_ ? 0 : 1);
  take_by_hand();
}

void TuningModel::take_by_hand() {
  for (const sweep::PresetJob::Measured& done : by_hand_.take()) add({by_hand_values_, done.numbers, true});
}

void TuningModel::add(Point point) {
  const auto at = std::lower_bound(points_.begin(), points_.end(), point.values,
                                   [](const Point& p, const std::vector<double>& v) { return p.values < v; });
  if (at != points_.end() && at->values == point.values) {
    at->numbers = point.numbers;
    return;
  }
  if (points_.size() < kMostPoints) points_.insert(at, std::move(point));
}

bool TuningModel::outdated() const { return !points_.empty() && !(without(presets_.current(), axes_) == points_base_); }

void TuningModel::try_point(std::size_t i) {
  if (i >= points_.size()) return;
  std::vector<std::pair<const PresetKey*, double>> values;
  for (const Axis& axis : axes_) {
    if (axis.key != nullptr) values.emplace_back(axis.key, points_[i].values[values.size()]);
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
  if (!part) return messages_.refuse("no ticks to search over yet");
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
