#include "core/contact/follow/follow.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Whether the normal has turned by more than the finger's motion explains: about a contact h from its centre it turns
/// by the way over h.
bool has_turned_over(const ContactContext& context, const TrackedPlane& kept, const IterationResult& now) {
  const double cosine = glm::dot(kept.normal, now.plane.normal);
  if (cosine >= kJumpCosine) return false;
  if (context.moved_m > context.hystereses_m(kLeapOfFinger)) return true;
  const double explained = 2.0 * context.moved_m / std::abs(now.contact.height_m);
  return std::acos(std::max(-1.0, cosine)) - std::acos(kJumpCosine) > explained;
}

/// Whether the depth along the normal, which the force follows, has changed by more than the motion explains.
bool has_leapt_in_depth(const ContactContext& context, const TrackedPlane& kept, const IterationResult& now) {
  const double before = contact_on_plane(context.finger, context.pose, kept.point, kept.normal).penetration_m;
  const Vec3 change = std::max(0.0, now.contact.penetration_m) * now.plane.normal - std::max(0.0, before) * kept.normal;
  const double explained = 2.0 * context.moved_m + context.hystereses_m(kLeapDepth);
  return glm::dot(change, change) > explained * explained;
}

}  // namespace

Followed follow(ContactContext& context, const TrackedPlane& kept, bool sample_is_kept, IterationResult& result) {
  const bool robust = context.settings.method == Method::robust;
  const int limit = context.settings.max_iterations;
  iterate_kept(context, kept, sample_is_kept, robust ? std::min(kTrackBudget, limit) : limit, result);
  if (!result.converged()) return Followed::lost;
  if (!has_turned_over(context, kept, result)) {
    // The motion may explain as much as that, but over a fold the contact has leapt all the same.
    const bool over_fold = result.met_unstable && glm::dot(kept.normal, result.plane.normal) < kJumpCosine;
    return over_fold || has_leapt_in_depth(context, kept, result) ? Followed::branched : Followed::held;
  }
  if (result.met_unstable || !robust) return Followed::branched;
  if (context.trace) context.trace->amend_last(StopReason::leapt);
  return Followed::lost;
}

}  // namespace tangent
