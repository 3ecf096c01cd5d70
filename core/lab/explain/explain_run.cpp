#include "core/lab/explain/explain_run.h"

#include "core/lab/explain/find_cure.h"
#include "core/tick/sources.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tangent {
namespace {

class RunTrials {
 public:
  RunTrials(const std::shared_ptr<const ContactScene>& scene, const Preset& preset, const LostRun& run,
            const ExplainOptions& options)
      : stepper_(scene), preset_(preset), run_(run), options_(options) {}

  /// The last tick under `preset`, or the first that finds no contact.
  TickOutput solve(const Preset& preset) {
    TickState state = run_.before;
    TickOutput out;
    for (const TickInput& input : run_.inputs) {
      out = stepper_.step(preset, input, state);
      ++solves;
      if (!is_converged(out.status)) break;
    }
    return out;
  }
  /// As it was.
  TickOutput last() {
    TickState state = run_.before;
    TickOutput out;
    for (const TickInput& input : run_.inputs) out = stepper_.step(preset_, input, state);
    solves += static_cast<int>(run_.inputs.size());
    return out;
  }
  bool plain(const TickOutput& out) const { return !wants_explaining(out, options_); }

  TickCure cure_with(const CureCandidate& candidate) {
    const PresetKey& key = *find_preset_key(candidate.key);
    return find_cure_of(
        preset_, candidate,
        [&](double value) {
          Preset changed = preset_;
          key.set(changed, value);
          return solve(changed);
        },
        [&](const TickOutput& out) { return plain(out); });
  }
  /// With the value that cured the first alone.
  TickCure cure_of_first(const TickCure& first) {
    TickCure cure = first;
    cure.outcome = CureOutcome::none_in_range;
    if (first.outcome != CureOutcome::found || first.as_deep) return cure;
    Preset changed = preset_;
    first.key->set(changed, first.to);
    cure.proof = solve(changed);
    if (plain(cure.proof)) cure.outcome = CureOutcome::found;
    return cure;
  }
  TickCure robust_instead() {
    TickCure cure;
    cure.outcome = CureOutcome::none_in_range;
    if (preset_.solver.method == Method::robust || !is_smooth(preset_.solver.method)) return cure;
    const PresetKey& key = *find_preset_key("solver.method");
    Preset changed = preset_;
    changed.solver.method = Method::robust;
    const TickOutput out = solve(changed);
    if (plain(out)) cure = {CureOutcome::found, &key, key.get(preset_), key.get(changed), false, out};
    return cure;
  }

  int solves = 0;

 private:
  Stepper stepper_;
  const Preset& preset_;
  const LostRun& run_;
  const ExplainOptions& options_;
};

/// The gains both ways, where the method has them: of a run nobody knows which way is out.
std::vector<CureCandidate> gains_of(const Preset& preset) {
  if (reported_method(preset) != Method::paper) return {};
  const double reach = std::max(1e-3, preset.finger.reach_m());
  const SolverSettings& s = preset.solver;
  return {{"solver.gain_curvature_m", 1, std::max(reach, s.gain_curvature_m)},
          {"solver.gain_curvature_m", -1, std::max(reach, s.gain_curvature_m)},
          {"solver.gain_overall", -1, std::max(0.1, s.gain_overall)},
          {"solver.gain_overall", 1, std::max(0.1, s.gain_overall)},
          {"solver.gain_distance_per_m", 1, std::max(1.0 / reach, s.gain_distance_per_m)},
          {"solver.gain_distance_per_m", -1, std::max(1.0 / reach, s.gain_distance_per_m)}};
}

TickCure cure_of_run(RunTrials& trials, const Preset& preset, const TickCure& first) {
  if (const TickCure cure = trials.cure_of_first(first); cure.outcome == CureOutcome::found) return cure;
  TickCure best;
  best.outcome = CureOutcome::none_in_range;
  double least = 0.0;
  for (const CureCandidate& candidate : gains_of(preset)) {
    const TickCure cure = trials.cure_with(candidate);
    if (cure.outcome != CureOutcome::found) continue;
    const double change = std::abs(cure.to - cure.from) / candidate.scale;
    if (best.outcome == CureOutcome::found && change >= least) continue;
    best = cure;
    least = change;
  }
  return best.outcome == CureOutcome::found ? best : trials.robust_instead();
}

}  // namespace

bool was_lost(const TickState& before) {
  return before.has_previous && (!before.has_converged || before.last_converged_s < before.last_t_s);
}

TickExplanation explain_run(const std::shared_ptr<const ContactScene>& scene, const Preset& preset, const LostRun& run,
                            const ExplainOptions& options) {
  TickExplanation out = explain_tick(scene, preset, run.inputs.front(), run.before, options);
  if (run.inputs.size() < 2) return out;
  RunTrials trials(scene, preset, run, options);
  out.tick = trials.last();
  out.lost_before = run.inputs.size() - 1;
  out.cure = cure_of_run(trials, preset, out.cure);
  out.solves += trials.solves;
  return out;
}

}  // namespace tangent
