#include "workbench/gui/model/tune_model.h"

#include "workbench/recording/recording.h"
#include "workbench/session/background_thread.h"
#include "workbench/session/exploration_poses.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

constexpr std::size_t kMostRecorded = 10'000, kMostExplored = 40'000;  // ticks that each trial solves
constexpr std::size_t kTrialsAFrame = 12;                              // in simulated time

using Stop = std::function<bool()>;

sweep::Ground ground_over(std::shared_ptr<const ContactScene> scene, std::vector<TickInput> motion) {
  return {std::move(scene), std::make_shared<const std::vector<TickInput>>(std::move(motion))};
}

Result<std::vector<TickInput>> first_ticks(const std::filesystem::path& path, const Stop& stop) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  const RecordingInfo& info = recording->info();
  Result<TickReader> ticks = recording->ticks(info.first_tick, info.last_tick);
  if (!ticks) return tl::unexpected(ticks.error());
  std::vector<TickInput> out;
  RecordedTick tick;
  while (out.size() < kMostRecorded && !stop()) {
    const Result<bool> more = ticks->next(tick);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    out.push_back(tick.record.tick.input);
    out.back().unready = false;  // here everything is built
  }
  return out;
}

}  // namespace

TuneModel::TuneModel(const AppOptions& options, PresetModel& presets, TimeModel& time, const SceneModel& scene,
                     MessageLog& messages)
    : presets_(presets),
      time_(time),
      scene_(scene),
      messages_(messages),
      deterministic_(options.deterministic),
      can_evolve_(sweep::front_search_is_there()),
      question_(usual_question()) {
  asked_ = question_;
}

void TuneModel::update() {
  if (!ranges_chosen_) question_.ranges = usual_ranges(presets_.current());
  std::vector<sweep::Trial> fresh;
  if (running()) fresh = job_.take(deterministic_ ? kTrialsAFrame : 0);
  for (sweep::Trial& trial : fresh) add(std::move(trial));
  if (!fresh.empty()) list();
  if (ground_ == nullptr) ground_ = job_.ground();
  if (!verdict_) verdict_ = job_.verdict();
  if (const std::string failure = job_.take_failure(); !failure.empty()) messages_.say(Severity::error, failure);
  if (const auto found = places_.take()) take_failures(*found);
}

void TuneModel::set_objective(std::size_t i, const sweep::NumberColumn* column) {
  auto& list = question_.objectives;
  if (i > list.size() || i >= TuneQuestion::kMostObjectives) return;
  if (column == nullptr) {
    if (i > 0 && i < list.size()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
  const auto same = [&](const sweep::Objective& objective) { return objective.column == column; };
  if (const auto there = std::find_if(list.begin(), list.end(), same); there != list.end()) {
    if (i < list.size()) std::swap(*there, list[i]);
    return;
  }
  if (i == list.size()) list.emplace_back();
  list[i].column = column;
}

Status TuneModel::set_constraint(std::size_t i, std::string_view text) {
  auto& list = question_.constraints;
  if (text.empty()) {
    if (i < list.size()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
    return {};
  }
  const auto parsed = sweep::parse_constraint(text);
  if (!parsed) return tl::unexpected(parsed.error());
  std::vector<sweep::Constraint> wanted = list;
  const auto same = [&](const sweep::Constraint& there) {
    return there.of.column == parsed->of.column && there.most == parsed->most;
  };
  if (i >= wanted.size() && std::any_of(wanted.begin(), wanted.end(), same)) return {};  // it is kept to already
  if (i >= wanted.size()) {
    if (wanted.size() >= TuneQuestion::kMostConstraints) return fail("no more constraints than 4", {}, "take one out");
    wanted.push_back(*parsed);
  } else {
    wanted[i] = *parsed;
  }
  if (const Status fits = sweep::check_constraints(wanted); !fits) return fits;
  list = std::move(wanted);
  return {};
}

std::vector<const PresetKey*> TuneModel::keys() const {
  std::vector<const PresetKey*> out;
  for (const PresetKey& key : preset_keys())
    if (key.kind != KeyKind::choice && key.read_by.has(presets_.current().solver.method)) out.push_back(&key);
  return out;
}

void TuneModel::set_key(std::size_t i, const PresetKey* key) {
  auto& list = question_.ranges;
  if (i > list.size() || i >= TuneQuestion::kMostRanges) return;
  ranges_chosen_ = true;
  if (key == nullptr) {
    if (i < list.size()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
  const auto same = [&](const sweep::Range& range) { return range.key == key; };
  if (std::any_of(list.begin(), list.end(), same)) return;
  const auto usual = usual_ranges(presets_.current());
  const auto known = std::find_if(usual.begin(), usual.end(), same);
  if (i == list.size()) list.emplace_back();
  list[i] = known != usual.end() ? *known : slider_range(*key);
}

void TuneModel::set_range(std::size_t i, double from, double to) {
  if (i >= question_.ranges.size()) return;
  sweep::Range& range = question_.ranges[i];
  from = std::clamp(from, range.key->min, range.key->max);
  to = std::clamp(to, range.key->min, range.key->max);
  if (!(from < to))
    return messages_.say(Severity::warning,
                         range.key->full_name() + ": the range is empty; its first value has to be below its last");
  ranges_chosen_ = true;
  range.from = from;
  range.to = to;
  range.logarithmic = range.key->logarithmic && from > 0.0;
}

void TuneModel::set_trials(std::size_t trials) {
  question_.trials = std::clamp(trials, TuneQuestion::kFewestTrials, TuneQuestion::kMostTrials);
}

Result<TuneModel::Load> TuneModel::chosen_ticks() {
  const auto range = time_.chosen_range();
  const auto part = range ? time_.run_over(*range) : std::nullopt;
  if (!part) return fail("no ticks to tune on yet", {}, "let the servo run, or choose the exploration path");
  const HistorySnapshot& records = part->run.records;
  const std::uint32_t id = records.newest().scene_id;
  const auto scene = part->run.scenes.find(id);
  if (scene == part->run.scenes.end()) return fail("the mesh of these ticks is gone", {}, "choose newer ticks");
  std::size_t first = part->first;
  if (records.size() - first > kMostRecorded) first = records.size() - kMostRecorded;
  std::vector<TickInput> motion;
  for (std::size_t i = first; i < records.size(); ++i) {
    if (records[i].scene_id != id) continue;
    motion.push_back(records[i].tick.input);
    motion.back().unready = false;
  }
  motion_.kind = MotionKind::poses;
  motion_text_ = std::to_string(motion.size()) + " ticks" + (time_.selection_kept() ? ", A to B" : " in view");
  return Load([ground = ground_over(scene->second, std::move(motion))](const Stop&) -> Result<sweep::Ground> {
    return ground;
  });
}

Result<TuneModel::Load> TuneModel::choose_motion() {
  motion_ = {};
  if (question_.motion == TuneMotion::ticks) return chosen_ticks();
  if (question_.motion == TuneMotion::recording && time_.recording() == nullptr)
    return fail("no recording is open", {}, "open one, or tune on ticks");
  const auto scene = question_.motion == TuneMotion::recording ? time_.scene_of_tick() : scene_.current();
  if (scene == nullptr) return fail("there is no mesh to tune on", {}, "open one, and let a tick run on it");
  if (question_.motion == TuneMotion::exploration) {
    if (scene->planar() != nullptr)
      return fail("no exploration path is made over a 2D scene", {}, "tune on ticks instead");
    motion_.kind = MotionKind::around;
    motion_text_ = "exploration path";
    return Load([scene, finger = presets_.current().finger](const Stop&) -> Result<sweep::Ground> {
      auto path = exploration_poses(*scene, finger, ExplorationKind::around, ExplorationPace::varied);
      if (!path) return tl::unexpected(path.error());
      if (path->poses.size() > kMostExplored) path->poses.resize(kMostExplored);
      return ground_over(scene, std::move(path->poses));
    });
  }
  motion_.kind = MotionKind::recording;
  motion_.file = time_.recording()->path().string();
  motion_text_ = time_.recording()->path().filename().string();
  return Load([scene, path = time_.recording()->path()](const Stop& stop) -> Result<sweep::Ground> {
    auto motion = first_ticks(path, stop);
    if (!motion) return tl::unexpected(motion.error());
    return ground_over(scene, std::move(*motion));
  });
}

void TuneModel::start() {
  if (question_.ranges.empty()) return messages_.refuse("choose a value to tune first");
  const auto load = choose_motion();
  if (!load) return messages_.refuse(load.error().message());
  clear();
  asked_ = question_;
  base_ = presets_.current();
  sweep::FrontPlan plan;
  plan.base = base_;
  plan.ranges = asked_.ranges;
  plan.objectives = asked_.objectives;
  plan.constraints = asked_.constraints;
  plan.starts = {by_theory(base_), base_};
  plan.evaluations = asked_.trials;
  plan.evolve = asked_.evolve && can_evolve_;
  plan.threads = deterministic_ ? 1 : background_threads();
  job_.start(std::move(plan), *load);
}

void TuneModel::cancel() { job_.cancel(); }

void TuneModel::clear() {
  job_.cancel();
  places_.cancel();
  ground_.reset();
  trials_.clear();
  front_.clear();
  listed_.clear();
  brush_.reset();
  verdict_.reset();
  chosen_.reset();
  tried_slot_.reset();
  failures_.clear();
}

void TuneModel::add(sweep::Trial trial) {
  const auto beats = [&](std::size_t i) {
    const sweep::Trial& on = trials_[i];
    return sweep::dominates(on, trial) || (on.objectives == trial.objectives && on.missed == trial.missed);
  };
  const bool beaten = std::any_of(front_.begin(), front_.end(), beats);
  trials_.push_back(std::move(trial));
  if (beaten) return;
  const std::size_t mine = trials_.size() - 1;
  std::erase_if(front_, [&](std::size_t i) { return sweep::dominates(trials_[mine], trials_[i]); });
  const auto at = std::lower_bound(front_.begin(), front_.end(), mine, [&](std::size_t a, std::size_t b) {
    return trials_[a].objectives < trials_[b].objectives;
  });
  front_.insert(at, mine);
}

}  // namespace tangent
