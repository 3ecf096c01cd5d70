#include "core/contact/follow/follow.h"

#include "core/base/tolerances.h"

#include <algorithm>

namespace tangent {

Followed follow(ContactContext& context, const TrackedPlane& kept, bool sample_is_kept, IterationResult& result) {
  const bool robust = context.settings.method == Method::robust;
  const int limit = context.settings.max_iterations;
  iterate_kept(context, kept, sample_is_kept, robust ? std::min(kTrackBudget, limit) : limit, result);
  if (!result.converged()) return Followed::lost;
  // A normal that turns by more than this in one tick has jumped to another place.
  if (glm::dot(kept.normal, result.plane.normal) >= kJumpCosine) return Followed::held;
  if (result.met_unstable) return Followed::branched;
  if (!robust) return Followed::held;
  if (context.trace) context.trace->amend_last(StopReason::leapt);
  return Followed::lost;
}

}  // namespace tangent
