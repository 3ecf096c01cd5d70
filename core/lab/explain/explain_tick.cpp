#include "core/lab/explain/explain_tick.h"

#include "core/lab/explain/causes.h"
#include "core/tick/sources.h"

#include <cmath>

namespace tangent {
namespace {

bool is_usable(const FingerPose& pose) {
  return std::isfinite(glm::dot(pose.position, pose.position) + glm::dot(pose.orientation, pose.orientation));
}

/// What the ground or the gains do, once neither the finger's motion, nor another place, nor a defect is the cause.
TickCause cause_in_iteration(TickStudy& study) {
  if (find_limit(study)) return TickCause::limit_or_tolerance;
  if (study.run.empty()) return TickCause::not_told;
  if (const auto feature = study.planar() ? find_planar_feature(study) : find_feature(study)) return *feature;
  if (find_unstable(study)) return TickCause::unstable_ground;
  if (const auto gain = find_gain(study)) return *gain;
  if (!study.planar())
    if (const auto feature = find_feature_to_end(study)) return *feature;
  return find_other_facet(study) ? TickCause::other_facet : TickCause::not_told;
}

// From the specific to the general: what the tick itself reports, the finger's own motion, a defect without which the
// tick is plain, another place, planes that ran out, and last what every kind of ground can do.
TickCause cause_of(TickStudy& study) {
  const bool wanted = wants_explaining(study.tick(), study.trials.options);
  if (!is_usable(study.trials.input.finger)) return TickCause::bad_pose;
  if (!is_smooth(reported_method(study.preset()))) {
    if (find_unready(study)) return TickCause::unready;
    if (find_turned_facet(study)) return TickCause::other_facet;
    return wanted ? TickCause::not_told : TickCause::nothing;
  }
  if (!wanted) return TickCause::nothing;
  if (find_unready(study)) return TickCause::unready;
  if (find_first(study)) return TickCause::first_contact;
  if (find_leap(study)) return TickCause::finger_leapt;
  if (!study.run.empty()) {
    if (!study.planar() && find_sliver(study)) return TickCause::sliver;
    if (!study.planar() && find_wild_normal(study)) return TickCause::wild_normal;
    const bool doubtful = study.followed() && (!is_stable(study.run.back()) || study.is_astray());
    if (doubtful && find_unstable(study)) return TickCause::unstable_ground;
  }
  if (find_rival(study)) return TickCause::deeper_rival;
  if (find_rivals_nearby(study)) return TickCause::rivals_nearby;
  return cause_in_iteration(study);
}

}  // namespace

bool wants_explaining(const TickOutput& tick, const ExplainOptions& options) {
  return !is_converged(tick.status) || tick.event != TickEvent::none || tick.iterations > options.many_planes;
}

bool normal_jumped(const TickOutput& last, const TickOutput& tick) {
  return last.triangle != tick.triangle && glm::dot(last.normal, tick.normal) < kJumpCosine;
}

TickExplanation explain_tick(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                             const TickInput& input, const TickState& before, const ExplainOptions& options) {
  TickStudy study(scene, {preset, input, before, options});
  study.result.cause = cause_of(study);
  study.result.solves = study.trials.solves;
  return study.result;
}

}  // namespace tangent
