#include "core/tick/track.h"

#include "core/base/tolerances.h"
#include "core/contact/search/rivals.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// A normal that turns by more than this in one tick has jumped to another place.
bool jumped(const TrackedPlane& from, const TrackedPlane& to) { return glm::dot(from.normal, to.normal) < kJumpCosine; }

void adopt(TrackResult& result, const IterationResult& contact, const TrackedPlane& kept, TickEvent event) {
  if (contact.plane.triangle != kept.triangle) result.triangle_changes = std::max(1, result.triangle_changes);
  result.contact = contact;
  result.event = event;
}

/// Looks for a deeper place, where there could be one. `rank`: of the tracked contact.
void look_for_rival(IterationContext& context, const ContactScene& scene, TickState& state, double rank, double gone,
                    TrackResult& result) {
  const Vec3 moved = context.pose.position + context.origin - state.last_position;
  const double speed = state.has_previous ? std::sqrt(glm::dot(moved, moved)) : 0.0;
  // Where not even one tick ahead can be seen, as after a leap, looking ahead would be for nothing.
  const double most = kLargestWatch * std::abs(rank), ahead = speed < most ? std::min(kWatchTicks * speed, most) : 0.0;
  const double margin = ahead + kSmallestWatch * std::abs(rank);
  const double bound = rank - context.settings.switch_hysteresis_m;
  const RivalResult rival = find_rival(context, scene, result.contact, bound, margin, state.clearance, gone);
  result.evaluations += rival.evaluations;
  state.clearance = rival.clearance;
  if (!rival.deeper) return;
  adopt(result, rival.best, state.plane, TickEvent::switched);
  state.clearance = Clearance{};
}

void watch_for_rivals(IterationContext& context, const ContactScene& scene, TickState& state, TrackResult& result) {
  const double rank = contact_rank(context.finger, result.contact.contact);
  const double gone = gone_m(state.clearance, context.finger, context.pose);
  if (rival_possible(state.clearance, gone, rank - context.settings.switch_hysteresis_m))
    look_for_rival(context, scene, state, rank, gone, result);
}

}  // namespace

void track(IterationContext& context, const ContactScene& scene, TickState& state, bool sample_kept,
           TrackResult& result) {
  result.event = TickEvent::none;
  result.evaluations = 0;
  result.triangle_changes = 0;
  const bool first = state.plane.feature == Feature::none;
  const bool robust = context.settings.method == Method::robust;
  if (!first) {
    const int limit = context.settings.max_iterations;
    iterate_kept(context, state.plane, sample_kept, robust ? std::min(kTrackBudget, limit) : limit, result.contact);
    result.evaluations = result.contact.evaluations;
    result.triangle_changes = result.contact.triangle_changes;
    const bool jump = result.converged() && jumped(state.plane, result.contact.plane);
    // A contact that folds may go over into another one by itself; any other leap is a lost contact.
    if (jump && result.contact.met_unstable) result.event = TickEvent::branch;
    const bool lost = !result.converged() || (robust && jump && !result.contact.met_unstable);
    if (!lost) {
      watch_for_rivals(context, scene, state, result);
      return;
    }
    if (result.converged() && context.trace) context.trace->amend_last(StopReason::leapt);
  }
  state.clearance = Clearance{};
  const SeedResult seeded = seed_contact(context, scene, state.plane);
  result.evaluations += seeded.evaluations;
  if (seeded.found || first || seeded.best.contact.error_m < result.contact.contact.error_m)
    adopt(result, seeded.best, state.plane, TickEvent::reseed);
  result.event = first ? TickEvent::first : TickEvent::reseed;
}

}  // namespace tangent
