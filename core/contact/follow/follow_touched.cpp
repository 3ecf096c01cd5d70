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
    if (is_wall(kept.places[i])) continue;
    IterationResult r;
    iterate(quiet, kept.places[i], kTrackBudget, r);
    evaluations += r.evaluations;
    followed.folded = followed.folded || r.met_unstable;
    if (r.converged() && tracked && are_one_place(r.plane, *tracked, same)) {
      followed.merged = true;  // it is followed on as that
      continue;
    }
    if (!r.converged() || !pushes_with_others(r.contact)) {
      followed.lost = true;
      continue;
    }
    if (r.contact.penetration_m < -context.hystereses_m(kLeftTouch)) {
      followed.left.places[followed.left.count++] = r.plane;
      continue;
    }
    const std::size_t before = now.count;
    now.add({r.plane, r.contact}, same);
    followed.merged = followed.merged || now.count == before;
  }
  return followed;
}

bool can_be_followed(ContactContext& context, const TouchedContact& place, int& evaluations) {
  if (is_round(context.finger)) return true;
  SolverSettings settings = context.settings;
  settings.method = Method::robust;
  ContactContext quiet{context.cache, settings, context.finger, context.pose, context.origin};
  const SurfacePlace kept = place.plane;
  IterationResult r;
  iterate(quiet, kept, kTrackBudget, r);
  evaluations += r.evaluations;
  return r.converged() && are_one_place(r.plane, place.plane, kMergedPlaces * settings.tolerance_m);
}

}  // namespace tangent
