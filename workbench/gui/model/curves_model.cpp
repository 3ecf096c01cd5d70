#include "workbench/gui/model/curves_model.h"

#include "workbench/bench/curves_job.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

/// What has to be equal for the points to be the present values'.
Preset without_swept(Preset preset) {
  const SolverSettings plain;
  preset.solver.method = plain.method;
  preset.solver.tolerance_m = plain.tolerance_m;
  preset.solver.max_iterations = plain.max_iterations;
  return preset;
}

}  // namespace

CurvesModel::CurvesModel(const AppOptions& options, PresetModel& presets, TimeModel& past, MessageLog& messages)
    : presets_(presets),
      time_(past),
      messages_(messages),
      deterministic_(options.deterministic),
      job_(std::make_unique<bench::CurvesJob>()) {}

CurvesModel::~CurvesModel() = default;

void CurvesModel::cancel() { job_->cancel(); }

void CurvesModel::clear() {
  job_->cancel();
  job_->forget();
}

bool CurvesModel::running() const { return job_->running(); }

double CurvesModel::progress() const { return job_->progress(); }

std::shared_ptr<const bench::SpeedCurves> CurvesModel::curves() const { return job_->result(); }

void CurvesModel::start() {
  const auto chosen = time_.chosen_range();
  const auto part = chosen ? time_.run_over(*chosen) : std::nullopt;
  if (!part) return messages_.refuse("no ticks to measure yet");
  const HistorySnapshot& records = part->run.records;
  const std::uint32_t scene_id = records.newest().scene_id;
  const auto scene = part->run.scenes.find(scene_id);
  if (scene == part->run.scenes.end() || scene->second == nullptr)
    return messages_.refuse("the mesh of these ticks is gone");
  if (scene->second->planar() != nullptr)
    return messages_.refuse("speed against error is measured on meshes; this scene is 2D");
  bench::MotionPart motion{scene->second, presets_.current(), {}};
  ticks_.clear();
  const std::size_t first = std::max(part->first, records.size() - std::min(records.size(), kMostTicks));
  for (std::size_t i = first; i < records.size(); ++i) {
    if (records[i].scene_id != scene_id) continue;
    motion.poses.push_back(records[i].tick.input);
    ticks_.push_back(records[i].tick.tick);
  }
  range_ = {ticks_.front(), ticks_.back()};
  base_ = presets_.current();
  bench::SpeedCurvesOptions options;
  options.most_s = 30.0;
  // Within a frame: enough to draw, and the same number of rounds wherever it runs.
  if (deterministic_) options.rounds = bench::kLeastRounds;
  std::vector<bench::MotionPart> parts;
  parts.push_back(std::move(motion));
  job_->start(std::move(parts), std::move(options), !deterministic_);
}

bool CurvesModel::outdated() const {
  return curves() != nullptr && !(without_swept(presets_.current()) == without_swept(base_));
}

std::optional<std::uint64_t> CurvesModel::worst_tick(std::size_t i) const {
  const auto shown = curves();
  if (shown == nullptr || i >= shown->points.size() + shown->peers.size()) return std::nullopt;
  const std::size_t pose =
      i < shown->points.size() ? shown->points[i].errors.worst.tick : shown->peers[i - shown->points.size()].worst.tick;
  return pose < ticks_.size() ? std::optional(ticks_[pose]) : std::nullopt;
}

void CurvesModel::open(std::size_t i) {
  const auto tick = worst_tick(i);
  if (!tick) return messages_.refuse("no such point is measured");
  if (!time_.reaches(*tick)) return messages_.refuse("the tick behind this point is no longer recorded");
  time_.select_tick(*tick);
  const auto shown = curves();
  if (i >= shown->points.size()) return;
  const SolverSettings solver = bench::with_setting(presets_.current(), shown->points[i].setting).solver;
  const std::array<std::pair<const PresetKey*, double>, 3> values{
      {{find_preset_key("solver", "method"), static_cast<double>(solver.method)},
       {find_preset_key("solver", "tolerance_m"), shown->points[i].setting.tolerance_m},
       {find_preset_key("solver", "max_iterations"), shown->points[i].setting.max_iterations}}};
  presets_.set_values("a measured point", values);
}

}  // namespace tangent
