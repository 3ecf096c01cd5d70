#include "core/lab/explain/causes.h"

#include "core/contact/contact_rank.h"
#include "core/lab/explain/find_cure.h"
#include "core/tick/sources.h"

#include <algorithm>

namespace tangent {
namespace {}  // namespace

bool find_rival(TickStudy& study) {
  if (study.tick().event != TickEvent::switched || !study.followed()) return false;
  const IterationRecord& tracked = study.run.back();
  const double was = contact_rank(study.preset().finger, study.contact_of(tracked.point, tracked.normal));
  const double now = contact_rank(study.preset().finger, study.contact_of(study.tick().contact, study.tick().normal));
  const bool tremor =
      wants_touched(study.preset()) && study.contact_of(tracked.point, tracked.normal).penetration_m > 0.0;
  const double limit = (tremor ? kTremor : 1.0) * study.preset().solver.switch_hysteresis_m;
  study.result.decided = {"how much deeper the other place is", tremor ? "5 switch hystereses" : "switch hysteresis",
                          "m", was - now, limit};
  study.place_at(study.tick().triangle, 0, study.tick().contact);
  const CureCandidate wider[]{
      {"solver.switch_hysteresis_m", 1, std::max(1e-6, study.preset().solver.switch_hysteresis_m)}};
  study.result.cure = find_cure(study.trials, wider);
  return true;
}

bool find_rivals_nearby(TickStudy& study) {
  if (study.tick().event != TickEvent::none || !study.followed()) return false;
  const auto followed_planes = static_cast<double>(study.run.size() - 1);
  if (followed_planes > study.trials.options.many_planes) return false;
  study.result.decided = {"iterations, with those for other places", "iterations a plain tick may take", "1",
                          static_cast<double>(study.tick().iterations),
                          static_cast<double>(study.trials.options.many_planes)};
  return true;
}

bool others_were_the_trouble(const TickStudy& study) {
  return study.followed() && static_cast<int>(study.run.size()) - 1 <= study.trials.options.many_planes;
}

}  // namespace tangent
