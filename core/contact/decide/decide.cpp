#include "core/contact/decide/decide.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <limits>

namespace tangent {
namespace {

void adopt(const IterationResult& contact, const TrackedPlane& kept, DecidedContact& decided) {
  if (contact.plane.triangle != kept.triangle) decided.triangle_changes = std::max(1, decided.triangle_changes);
  decided.contact = contact;
}

}  // namespace

/// Whether the centre of a finger that is not round is behind what it touches.
static bool is_behind(const Finger& finger, const PlaneContact& contact) {
  return !is_round(finger) && contact.height_m < 0.0 && contact.penetration_m > 0.0;
}

Takeover takeover_from(const ContactContext& context, const PlaneContact& followed, bool pushes_alone,
                       double hystereses) {
  const double bound = takeover_bound_m(context.settings, contact_rank(context.finger, followed), hystereses);
  if (pushes_alone && is_behind(context.finger, followed)) {
    const bool closed = context.cache.mesh().is_body();
    const double way_out = closed ? context.soon_touched_rank() : context.finger.reach_m();
    return {std::min(bound, way_out), way_out < bound};
  }
  if (!is_free(context.finger, followed)) return {bound, false};
  const double soon = context.soon_touched_rank();
  return {std::min(bound, soon), soon < bound};
}

void decide_followed(Followed followed, bool first, DecidedContact& decided) {
  decided.event = followed == Followed::branched ? TickEvent::branch : TickEvent::none;
  decided.evaluations = first ? 0 : decided.contact.evaluations;
  decided.triangle_changes = first ? 0 : decided.contact.triangle_changes;
}

bool was_put_elsewhere(const FingerStep& step) { return step.moved_m > kLeapOfFinger * step.switch_hysteresis_m; }

/// How much deeper a place can have become since the last tick and on the way before it: no depth changes by more than
/// the finger moves.
static double explained_m(const FingerStep& step, double way_before_m) {
  const double before = std::min(way_before_m, kMostLateEntry * step.switch_hysteresis_m);
  return 2.0 * (step.moved_m + before) + (1.0 + kEnteredDepth) * step.switch_hysteresis_m;
}
static double entered_beside_m(const FingerStep& step, double tracked_depth_m) {
  return std::max(0.0, tracked_depth_m) + explained_m(step, step.late_m + step.lost_m);
}

bool was_entered(const FingerStep& step, double depth_m, double tracked_depth_m) {
  return was_put_elsewhere(step) || depth_m <= entered_beside_m(step, tracked_depth_m);
}

double unentered_for_m(const FingerStep& step, double depth_m, double tracked_depth_m) {
  return was_put_elsewhere(step) ? 0.0 : 0.5 * std::max(0.0, depth_m - entered_beside_m(step, tracked_depth_m));
}

bool is_pressed(const FingerStep& step, double before_m) {
  return !was_put_elsewhere(step) && before_m > explained_m(step, step.late_m);
}

bool came_out(const FingerStep& step, double depth_m) {
  return -depth_m <= step.moved_m + step.late_m + step.switch_hysteresis_m;
}

double deepest_entered_m(const FingerStep& step, double before_m, bool was_free) {
  if (was_put_elsewhere(step)) return std::numeric_limits<double>::infinity();
  return was_free ? entered_beside_m(step, 0.0) : std::max(0.0, before_m) + kLeapOfFinger * step.switch_hysteresis_m;
}

/// Behind a sheet its rim, where it is not touched, ranks before the place that pushes there. Out of a closed body the
/// finger has come at its far side.
static bool is_no_way_out(const ContactContext& context, const TouchedContact& place, const TouchedContact& tracked) {
  if (!is_free(context.finger, place.contact) || !is_behind(context.finger, tracked.contact)) return false;
  return !context.cache.mesh().is_body() || !faces_away(place.plane, tracked.plane);
}

bool decide_rival(const ContactContext& context, const RivalResult& rival, double tracked_depth_m,
                  const TrackedPlane& kept, DecidedContact& decided) {
  decided.evaluations += rival.evaluations;
  if (!rival.deeper) return false;
  const FingerStep step = step_of(context);
  if (!was_entered(step, rival.best.contact.penetration_m, tracked_depth_m)) return false;
  const TouchedContact tracked{decided.contact.plane, decided.contact.contact};
  if (tracked_depth_m > 0.0 && is_no_way_out(context, {rival.best.plane, rival.best.contact}, tracked)) return false;
  if (tracked_depth_m > 0.0 && !was_put_elsewhere(step) && is_far_side({rival.best.plane, rival.best.contact}, tracked))
    return false;
  adopt(rival.best, kept, decided);
  decided.event = TickEvent::switched;
  return true;
}

/// Whether the finger has left the closed body that it is behind the surface of: it is out, by more than a tremor, of a
/// place that is nearer.
static bool has_left_at(const ContactContext& context, const PlaneContact& place, const PlaneContact& tracked) {
  return context.cache.mesh().is_body() && tracked.penetration_m > 0.0 && !pushes_with_others(tracked) &&
         place.penetration_m < -context.hystereses_m(kTremor) &&
         contact_rank(context.finger, place) <
             takeover_bound_m(context.settings, contact_rank(context.finger, tracked));
}

bool decide_touched(ContactContext& context, double bound_m, TouchedContacts& touched, const TrackedPlane& kept,
                    DecidedContact& decided) {
  TouchedContact* deepest = nullptr;
  for (TouchedContact& c : std::span(touched.contacts).first(touched.count))
    if (!deepest || c.contact.penetration_m > deepest->contact.penetration_m) deepest = &c;
  if (!deepest) return false;
  const TouchedContact tracked{decided.contact.plane, decided.contact.contact};
  if (!(contact_rank(context.finger, deepest->contact) < bound_m) &&
      !(decided.converged() && has_left_at(context, deepest->contact, tracked.contact)))
    return false;
  if (decided.converged() && is_no_way_out(context, *deepest, tracked)) return false;
  IterationResult contact;
  ContactContext quiet = context;
  quiet.trace = nullptr;
  lead(quiet, deepest->plane, contact);
  decided.evaluations += contact.evaluations;
  if (!contact.converged()) return false;
  *deepest = {decided.contact.plane, decided.contact.contact};
  adopt(contact, kept, decided);
  decided.event = TickEvent::switched;
  return true;
}

bool decide_deeper_start(const ContactContext& context, const SeedResult& seeded, const TrackedPlane& kept,
                         DecidedContact& decided) {
  const double bound = takeover_bound_m(context.settings, contact_rank(context.finger, decided.contact.contact));
  if (!seeded.best.converged() || !(contact_rank(context.finger, seeded.best.contact) < bound)) {
    decided.evaluations += seeded.evaluations;
    return false;
  }
  decide_start(seeded, kept, decided);
  return true;
}

void decide_start(const SeedResult& seeded, const TrackedPlane& kept, DecidedContact& decided) {
  const bool first = kept.feature == Feature::none;
  decided.evaluations += seeded.evaluations;
  if (seeded.found || first || seeded.best.contact.error_m < decided.contact.contact.error_m)
    adopt(seeded.best, kept, decided);
  decided.event = first ? TickEvent::first : TickEvent::reseed;
}

}  // namespace tangent
