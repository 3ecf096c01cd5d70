#include "core/contact/follow/follow_touched.h"

#include "core/base/tolerances.h"

namespace tangent {

FollowedPlaces follow_touched(ContactContext& context, const TouchedPlaces& kept, const TrackedPlane* tracked,
                              TouchedContacts& now, int& evaluations) {
  FollowedPlaces followed;
  now.count = 0;
  if (kept.count == 0) return followed;
  SolverSettings settings = context.settings;
  settings.method = Method::robust;
  ContactContext quiet{context.cache, settings, context.finger, context.pose, context.origin};
  const double same = kMergedPlaces * settings.tolerance_m;
  for (std::uint32_t i = 0; i < kept.count; ++i) {
    IterationResult r;
    iterate(quiet, kept.places[i], kTrackBudget, r);
    evaluations += r.evaluations;
    followed.folded = followed.folded || r.met_unstable;
    const bool merged = tracked && glm::distance(r.plane.point, tracked->point) <= same;
    if (!r.converged() || !pushes_with_others(r.contact) || merged ||
        r.contact.penetration_m < -context.hystereses_m(kLeftTouch))
      continue;
    now.add({r.plane, r.contact}, same);
  }
  followed.all = now.count == kept.count;
  return followed;
}

}  // namespace tangent
