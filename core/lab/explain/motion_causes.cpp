#include "core/lab/explain/causes.h"

#include "core/lab/explain/find_cure.h"
#include "core/tick/sources.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr double kMostSubsteps = 64.0;

/// `robust` in place of a raw mesh's method: the same two ticks.
void cure_by_smooth_method(TickStudy& study, const TickInput& last, const TickOutput& was) {
  TickCure& cure = study.result.cure;
  cure.outcome = CureOutcome::none_in_range;
  const PresetKey& key = *find_preset_key("solver.method");
  if (study.preset().force.source != ForceSource::method) return;
  Preset changed = study.preset();
  changed.solver.method = Method::robust;
  TickState state;
  const TickOutput first = study.trials.step(changed, last, state);
  const TickOutput second = study.trials.step(changed, study.trials.input, state);
  const double turn = angle_between_deg(first.normal, second.normal);
  if (!study.trials.plain(second) || !(turn < angle_between_deg(was.normal, study.tick().normal)) || turn > kJumpDeg)
    return;
  cure = {CureOutcome::found, &key, key.get(study.preset()), key.get(changed), false, second};
}

double way_m(const TickStudy& study) {
  return study.before().has_previous ? glm::distance(study.trials.input.finger.position, study.before().last_position)
                                     : 0.0;
}

/// In smaller steps every tick is plain.
bool plain_in_steps(TickStudy& study, double limit) {
  const double steps = std::min(std::ceil(way_m(study) / (0.2 * limit)), kMostSubsteps);
  TickState state = study.before();
  const FingerPose from{study.before().last_position, study.before().last_orientation}, to = study.trials.input.finger;
  for (double i = 1.0; i <= steps; ++i) {
    const double f = i / steps;
    const FingerPose pose{glm::mix(from.position, to.position, f), glm::slerp(from.orientation, to.orientation, f)};
    const double t_s = study.before().last_t_s + f * (study.trials.input.t_s - study.before().last_t_s);
    if (!study.trials.plain(study.trials.step(study.preset(), {t_s, pose}, state))) return false;
  }
  return true;
}

/// Put there anew the finger stays there without an event.
bool plain_from_nothing(TickStudy& study) {
  TickState state;
  const TickOutput first = study.trials.step(study.preset(), study.trials.input, state);
  if (!is_converged(first.status)) return false;
  return study.trials.plain(study.trials.step(study.preset(), study.trials.input, state));
}

}  // namespace

bool find_turned_facet(TickStudy& study) {
  if (!study.before().has_previous || !is_converged(study.tick().status)) return false;
  TickState state = study.before();
  const TickInput last{study.before().last_t_s, {study.before().last_position, study.before().last_orientation}};
  const TickOutput was = study.trials.step(study.preset(), last, state);
  const double turn = angle_between_deg(was.normal, study.tick().normal), limit = kJumpDeg;
  if (!(turn > limit) || was.triangle == study.tick().triangle) return false;
  study.result.decided = {"turn of the normal in one tick", "what counts as a jump", "deg", turn, limit};
  study.place_at(study.tick().triangle, 0, study.tick().contact);
  cure_by_smooth_method(study, last, was);
  return true;
}

bool find_unready(TickStudy& study) {
  if (!study.trials.input.unready || study.planar()) return false;
  const TickState& before = study.before();
  if (before.has_converged)
    study.result.decided = {"time since a contact was last found", "how long its force stays whole", "s",
                            study.trials.input.t_s - before.last_converged_s, study.preset().safety.unconverged_hold_s};
  TickInput ready = study.trials.input;
  ready.unready = false;
  TickState state = before;
  const TickOutput out = study.trials.step(study.preset(), ready, state);
  if (out.triangle == kNone || !is_converged(out.status)) return true;
  study.place_at(out.triangle, 0, out.contact);
  study.result.mesh.mended = study.trials.plain(out, true);
  study.result.mesh.proof = out;
  return true;
}

bool find_first(const TickStudy& study) {
  if (study.tick().event != TickEvent::first || !is_converged(study.tick().status)) return false;
  // Many planes are what starting from nothing takes, but for the one seed of the other methods.
  const bool searched = study.trials.scene().planar() || reported_method(study.preset()) == Method::robust;
  return searched || study.tick().iterations <= study.trials.options.many_planes;
}

bool find_leap(TickStudy& study) {
  const double limit = kLeapOfFinger * study.preset().solver.switch_hysteresis_m;
  if (study.trials.is_first() || !(way_m(study) > limit)) return false;
  if (!plain_in_steps(study, limit) && !plain_from_nothing(study)) return false;
  study.result.decided = {"the finger's way in one tick", "what counts as put elsewhere", "m", way_m(study), limit};
  return true;
}

}  // namespace tangent
