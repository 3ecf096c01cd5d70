#include "core/lab/explain/causes.h"

#include "core/lab/explain/find_cure.h"
#include "core/tick/sources.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tangent {
namespace {

constexpr double kSoundRate = 0.5;  // a plane leaves at most this of the error where the gains are right
constexpr int kUnlimitedPlanes = 2000;
constexpr double kRoundingShare = 1e-13;  // of the scene's size: errors below are rounding

/// Mean share of the error that a plane of the run leaves.
double rate_of(std::span<const IterationRecord> run, double tolerance_m) {
  if (run.size() < 2) return 0.0;
  const double last = std::max(run.back().error_m, 1e-3 * tolerance_m);
  return std::pow(last / run.front().error_m, 1.0 / static_cast<double>(run.size() - 1));
}

/// What the planes of the paper's iteration undo of the travel: 1 is right, above it they overshoot.
struct Undone {
  double share, gain;  ///< medians
};

std::optional<Undone> undone_by(const TickStudy& study, std::span<const IterationRecord> run, std::size_t first) {
  if (reported_method(study.preset()) != Method::paper) return std::nullopt;
  std::vector<double> shares, gains;
  for (std::size_t i = first; i + 1 < run.size(); ++i) {
    const Vec3 &now = run[i].travel, &next = run[i + 1].travel;
    if (!(run[i].error_m > 0.0) || run[i].gain == 0.0) continue;
    shares.push_back(1.0 - glm::dot(next, now) / glm::dot(now, now));
    gains.push_back(run[i].gain);
  }
  if (shares.empty()) return std::nullopt;
  const auto middle = [](std::vector<double>& values) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  return Undone{middle(shares), middle(gains)};
}

double scene_size_m(const TickStudy& study) {
  const double box = study.trials.scene().has_mesh() ? glm::length(study.mesh().bounds().size()) : 0.0;
  return std::max(box, glm::length(study.trials.input.finger.position)) + study.preset().finger.reach_m();
}

TickCure smaller_finger(TickStudy& study, const Vec3& normal) {
  const Finger& finger = study.preset().finger;
  if (finger.shape != FingerShape::sphere) return {};
  const PresetKey& key = *find_preset_key("finger.radius_m");
  TickCure cure = find_cure_of(
      study.preset(), {"finger.radius_m", -1, finger.radius_m},
      [&](double radius) {
        Preset changed = study.preset();
        key.set(changed, radius);
        const Vec3 nearer = (radius - finger.radius_m) * normal;
        TickState state = study.before();
        state.last_position += nearer;
        state.clearance = Clearance{};
        TickInput input = study.trials.input;
        input.finger.position += nearer;
        return study.trials.step(changed, input, state);
      },
      [&](const TickOutput& out) { return study.trials.plain(out, study.trials.is_first()); });
  cure.as_deep = true;
  return cure;
}

/// The iteration on a polygon has no gains.
TickCure robust_instead(TickStudy& study) {
  TickCure cure;
  cure.outcome = CureOutcome::none_in_range;
  const PresetKey& key = *find_preset_key("solver.method");
  Preset changed = study.preset();
  changed.solver.method = Method::robust;
  const TickOutput out = study.trials.solve(changed);
  if (study.trials.plain(out, study.trials.is_first()))
    cure = {CureOutcome::found, &key, key.get(study.preset()), key.get(changed), false, out};
  return cure;
}

/// By the raw mesh where the tick itself does not know: the planes of an iteration that fails may lie anywhere.
bool is_untouched(TickStudy& study) {
  if (is_converged(study.tick().status)) return study.tick().status == TickStatus::free;
  Preset raw = study.preset();
  raw.solver.method = Method::facet;
  return study.trials.solve(raw).status == TickStatus::free;
}

}  // namespace

bool find_limit(TickStudy& study) {
  if (study.run.empty()) return false;
  Preset unlimited = study.preset();
  unlimited.solver.max_iterations = std::max(kUnlimitedPlanes, study.preset().solver.max_iterations);
  const auto trace = std::make_unique<IterationTrace>();
  study.trials.solve(unlimited, trace.get());
  const auto run = first_run(*trace);
  if (run.empty()) return false;
  const double tolerance = study.preset().solver.tolerance_m;
  double least = std::numeric_limits<double>::infinity();
  for (const IterationRecord& r : run) least = std::min(least, r.error_m);
  const auto undone = undone_by(study, run, run.size() / 2);
  const bool sound = rate_of(run, tolerance) <= kSoundRate && (!undone || std::abs(1.0 - undone->share) <= kSoundRate);
  const bool converged = run.back().stop == StopReason::converged && sound;
  const bool rounding = least >= tolerance && least <= kRoundingShare * scene_size_m(study);
  if (!converged && !rounding) return false;
  const auto needed = static_cast<double>(run.size() - 1);
  const double limit = std::min(study.preset().solver.max_iterations, study.trials.options.many_planes);
  if (rounding)
    study.result.decided = {"least error that rounding leaves", "tolerance", "m", least, tolerance};
  else if (needed > limit)
    study.result.decided = {"iterations needed", "iterations allowed", "1", needed, limit};
  else
    return false;
  const CureCandidate wider[]{{"solver.max_iterations", 1, static_cast<double>(study.preset().solver.max_iterations)},
                              {"solver.tolerance_m", 1, std::max(1e-12, tolerance)}};
  const bool stopped = !is_converged(study.tick().status) || study.tick().event != TickEvent::none;
  const TickCure cure = find_cure(study.trials, wider, stopped ? CuredWhen::converged : CuredWhen::plain);
  if (cure.outcome != CureOutcome::found) {
    study.result.decided = {};
    return false;
  }
  study.result.cure = cure;
  return true;
}

bool find_unstable(TickStudy& study) {
  const IterationRecord* at = nullptr;
  for (const IterationRecord& r : study.near)
    if (!is_stable(r) && (!at || r.error_m < at->error_m)) at = &r;
  if (!at) return false;
  const double h = study.contact_of(at->point, at->normal).height_m;
  const double root = std::sqrt(std::max(0.0, 0.25 * at->trace_m * at->trace_m - at->det_m));
  // 1 + h k of the most hollow direction; on a polygon there is one, and det M is that.
  const double least = study.planar() ? at->det_m : 0.5 * at->trace_m - root;
  // Seen from inside (h < 0) a bulge is a hollow.
  study.result.decided = {"distance of the finger's centre from the contact", "radius of the hollow", "m", std::abs(h),
                          std::abs(h / (1.0 - least))};
  study.place_at(at->triangle, 0, at->point);
  // A finger in the air renders nothing that a smaller one would render better.
  study.result.untouched = is_untouched(study);
  if (!study.result.untouched) study.result.cure = smaller_finger(study, at->normal);
  return true;
}

std::optional<TickCause> find_gain(TickStudy& study) {
  if (study.run.size() < 3) return std::nullopt;
  // Where the run went astray, what came first tells, else where it ended.
  const auto undone = study.is_astray() ? undone_by(study, study.run.first(study.near.size() + 1), 0)
                                        : undone_by(study, study.run, study.run.size() / 2);
  if (!undone || !(undone->share > 0.0)) return std::nullopt;
  const auto [share, gain] = *undone;
  const bool large = share > 1.0;
  study.result.decided = {"gain", "ideal gain in the direction of travel", "1", gain, gain / share};
  study.place_at(study.run.back().triangle, 0, study.run.back().point);
  if (study.planar()) {
    study.result.cure = robust_instead(study);
    return large ? TickCause::gain_too_large : TickCause::gain_too_small;
  }
  const SolverSettings& s = study.preset().solver;
  const double reach = std::max(1e-3, study.preset().finger.reach_m());
  const CureCandidate gains_to_change[]{
      {"solver.gain_curvature_m", large ? 1 : -1, std::max(reach, s.gain_curvature_m)},
      {"solver.gain_overall", large ? -1 : 1, std::max(0.1, s.gain_overall)},
      {"solver.gain_distance_per_m", large ? 1 : -1, std::max(1.0 / reach, s.gain_distance_per_m)}};
  study.result.cure = find_cure(study.trials, gains_to_change);
  return large ? TickCause::gain_too_large : TickCause::gain_too_small;
}

}  // namespace tangent
