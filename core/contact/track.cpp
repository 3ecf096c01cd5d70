#include "core/contact/track.h"

#include "core/base/tolerances.h"

#include <algorithm>

namespace tangent {

TrackResult track(IterationContext& context, const NearestTriangles& nearest, const TickState& state,
                  const PlaceSample* kept_sample) {
  TrackResult result;
  const bool first = state.plane.feature == Feature::none;
  if (!first) {
    const int limit = context.settings.max_iterations;
    const int budget = context.settings.method == Method::robust ? std::min(kTrackBudget, limit) : limit;
    result.contact = iterate(context, state.plane, true, kept_sample, budget);
    result.evaluations = result.contact.evaluations;
    result.triangle_changes = result.contact.triangle_changes;
    if (result.converged()) return result;
  }
  const SeedResult seeded = seed_contact(context, nearest);
  result.event = first ? TickEvent::first : TickEvent::reseed;
  result.evaluations += seeded.evaluations;
  if (seeded.found || first || seeded.best.contact.error_m < result.contact.contact.error_m) {
    if (!first && seeded.best.plane.triangle != state.plane.triangle) result.triangle_changes = std::max(1, result.triangle_changes);
    result.contact = seeded.best;
  }
  return result;
}

}  // namespace tangent
