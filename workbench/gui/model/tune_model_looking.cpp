// What TuneModel lets one do with the trials: brush them, see where they fail, try one.
#include "core/lab/measure/surface_map.h"
#include "workbench/evidence/run_evidence.h"
#include "workbench/gui/model/tune_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {

namespace {

constexpr std::size_t kMostLookedAt = 12;            // presets that are solved again for the map of failures
constexpr std::uint64_t kOwnVersions = 1ull << 62u;  // apart from those of the map (MapPaint::version)
constexpr double kLeastRange = 0.01;                 // share of failing ticks at the colour bar's upper end

}  // namespace

bool TuneModel::on_front(std::size_t trial) const {
  return std::find(front_.begin(), front_.end(), trial) != front_.end();
}

std::optional<std::size_t> TuneModel::balanced() const {
  return front_.empty() ? std::nullopt : std::optional(sweep::balanced(trials_, front_));
}

Preset TuneModel::preset_of(std::size_t trial) const {
  Preset out = base_;
  for (std::size_t r = 0; r < asked_.ranges.size(); ++r) asked_.ranges[r].key->set(out, trials_[trial].values[r]);
  return out;
}

bool TuneModel::outdated() const {
  if (trials_.empty()) return false;
  Preset now = presets_.current();
  for (const sweep::Range& range : asked_.ranges) range.key->set(now, range.key->get(base_));
  return !same_for_solver(now, base_) || (ground_ != nullptr && ground_->scene != scene_.current());
}

std::optional<double> TuneModel::theory(std::size_t range) const {
  return theory_value(*asked_.ranges[range].key, base_.finger);
}

void TuneModel::set_brush(const std::optional<TuneBrush>& brush) {
  brush_ = brush;
  list();
  look_for_failures();
}

void TuneModel::list() {
  listed_.clear();
  if (!brush_) {
    listed_ = front_;
    return;
  }
  for (std::size_t i = 0; i < trials_.size(); ++i)
    if (brushed(i)) listed_.push_back(i);
  std::sort(listed_.begin(), listed_.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(trials_[a].missed, trials_[a].objectives) < std::pair(trials_[b].missed, trials_[b].objectives);
  });
}

void TuneModel::show_failures(bool show) {
  show_failures_ = show;
  look_for_failures();
}

void TuneModel::look_for_failures() {
  places_.cancel();
  failures_.clear();
  if (!show_failures_ || ground_ == nullptr || listed_.empty()) return;
  if (ground_->scene->planar() != nullptr) return messages_.say(Severity::note, "a 2D scene has no map of failures");
  std::vector<Preset> presets;
  const std::size_t count = std::min(kMostLookedAt, listed_.size());
  for (std::size_t i = 0; i < count; ++i) presets.push_back(preset_of(listed_[i * listed_.size() / count]));
  wanted_of_ = count;
  places_.start(*ground_, std::move(presets), !deterministic_);
  if (const auto found = places_.take()) take_failures(*found);
}

void TuneModel::take_failures(const std::vector<sweep::TicksThere>& found) {
  const ContactMesh& mesh = ground_->scene->mesh();
  failures_.clear();
  most_failures_ = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const sweep::TicksThere& there = found[t];
    const double share = there.ticks > 0 ? static_cast<double>(there.failed) / static_cast<double>(there.ticks) : 0.0;
    failures_.push_back(there.ticks > 0 ? static_cast<float>(share) : kMapNoValue);
    most_failures_ = std::max(most_failures_, share);
  }
  failures_of_ = wanted_of_;
  ++failures_version_;
}

std::optional<MapPaint> TuneModel::paint(ColourMap colours) const {
  if (!show_failures_ || failures_.empty() || ground_ == nullptr || ground_->scene != scene_.current())
    return std::nullopt;
  MapPaint out;
  out.values = failures_;
  out.version = kOwnVersions + failures_version_;
  out.low = 0.0;
  out.high = std::max(kLeastRange, most_failures_);
  out.colours = colours;
  return out;
}

void TuneModel::try_trial(std::size_t trial) {
  if (trial >= trials_.size()) return messages_.refuse("there is no trial " + std::to_string(trial + 1));
  std::vector<std::pair<const PresetKey*, double>> values;
  for (std::size_t r = 0; r < asked_.ranges.size(); ++r)
    values.emplace_back(asked_.ranges[r].key, trials_[trial].values[r]);
  const std::string what = "trial " + std::to_string(trial + 1);
  if (tried())
    presets_.set_values(what, values);
  else
    presets_.try_values(what, values);
  chosen_ = trial;
  tried_slot_ = presets_.slots().active_slot();
  time_.other_slot_beside = true;  // while live: what there was stays in the plots
}

bool TuneModel::has_values_of(std::size_t trial) const {
  for (std::size_t r = 0; r < asked_.ranges.size(); ++r)
    if (asked_.ranges[r].key->get(presets_.current()) != trials_[trial].values[r]) return false;
  return true;
}

std::optional<std::size_t> TuneModel::in_use() const {
  return chosen_ && has_values_of(*chosen_) ? chosen_ : std::nullopt;
}

std::optional<std::size_t> TuneModel::tried() const {
  return tried_slot_ == presets_.slots().active_slot() ? in_use() : std::nullopt;
}

void TuneModel::keep() {
  const auto trial = tried();
  if (!trial) return messages_.refuse("try a trial first");
  presets_.copy_ab();
  presets_.toggle_ab();
  tried_slot_.reset();
  time_.other_slot_beside = false;
  messages_.say(Severity::note, "trial " + std::to_string(*trial + 1) + " kept");
}

void TuneModel::put_back() {
  if (!tried()) return messages_.refuse("no trial is tried");
  presets_.toggle_ab();
  tried_slot_.reset();
  time_.other_slot_beside = false;
}

void TuneModel::trial_refused() {
  if (!tried_slot_ || tried()) return;
  tried_slot_.reset();
  time_.other_slot_beside = false;
}

bool TuneModel::can_attach() const { return ground_ != nullptr && ground_->scene == scene_.current(); }

EvidenceMotion TuneModel::evidence_motion(const std::filesystem::path& folder) const {
  EvidenceMotion out = motion_;
  if (out.kind == MotionKind::recording) out.file = seen_from(folder, out.file);
  return out;
}

std::span<const TickInput> TuneModel::poses() const {
  return ground_ != nullptr && motion_.kind == MotionKind::poses ? std::span<const TickInput>(*ground_->motion)
                                                                 : std::span<const TickInput>();
}

}  // namespace tangent
