// Which place is rendered: the followed contact, a deeper one that takes over, or the one a lost contact starts anew
// at.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/decide/tick_event.h"
#include "core/contact/follow/follow.h"
#include "core/contact/search/rivals.h"
#include "core/contact/search/seed.h"
#include "core/contact/touched.h"

namespace tangent {

/// The contact that a tick renders, and what it cost.
struct DecidedContact {
  IterationResult contact;  ///< the converged one, or the best there was
  TickEvent event = TickEvent::none;
  int evaluations = 0;  ///< of the whole tick, lost tracking and seeds included
  int triangle_changes = 0;
  bool searching = false;       ///< the search for deeper places goes on at the next tick
  bool places_changed = false;  ///< a place that pushes beside it came up, was lost, or folded over on the way
  bool converged() const { return contact.converged(); }
  bool facing() const { return contact.facing(); }
};

/// Rank that another place must be below to take over from a contact of rank `rank`: deeper by the switch hysteresis,
/// or `hystereses` of them.
inline double takeover_bound_m(const SolverSettings& settings, double rank, double hystereses = 1.0) {
  return rank - hystereses * settings.switch_hysteresis_m;
}

/// Which other places count.
struct Takeover {
  double bound_m = 0.0;  ///< rank that they must be below
  bool stays = false;    ///< however the followed one's changes
};
/// Those that are deeper by so many hystereses. Of a finger that is not round and touches nothing, only those that it
/// may soon touch: where the others are nobody feels. Behind a place that `pushes_alone`, only those that it touches: a
/// rim beside it that is free is no way out. Of a closed body those, too, that it may soon touch: it may have come out.
Takeover takeover_from(const ContactContext& context, const PlaneContact& followed, bool pushes_alone,
                       double hystereses = 1.0);

/// The followed contact stays (decided.contact holds it), until another is decided on. `first`: there was none.
void decide_followed(Followed followed, bool first, DecidedContact& decided);

/// How far the finger has come since the last tick, and the length by which such things are judged.
struct FingerStep {
  double moved_m = 0.0;
  double switch_hysteresis_m = 0.0;
  double late_m = 0.0;  ///< the way before that in which nobody looked
  double lost_m = 0.0;  ///< of what was lost and may come up again (ContactContext)
};
inline FingerStep step_of(const ContactContext& context) {
  return {context.moved_m, context.settings.switch_hysteresis_m, context.late_m, context.lost_m};
}

/// Whether the finger has been put elsewhere, so far it has come: what it is in then counts as entered.
bool was_put_elsewhere(const FingerStep& step);

/// Whether a place this deep can have been entered from outside since the last tick, at which none was deeper than the
/// tracked one by more than the hysteresis: no depth changes by more than the finger moves.
bool was_entered(const FingerStep& step, double depth_m, double tracked_depth_m);

/// Of a place that was not entered: how far the finger goes at least before it may count, at the step's speed, m: both
/// depths change by no more than that. 0 where it was entered.
double unentered_for_m(const FingerStep& step, double depth_m, double tracked_depth_m);

/// How deep a place at which the contact leapt, or started anew where it was lost, can be if the finger has come into
/// it from outside: no deeper by over kLeapOfFinger than what was tracked, unless the finger has moved as far.
/// `before_m`: depth of what was tracked; `was_free`: in the last tick, in which a contact was found and touched
/// nothing.
double deepest_entered_m(const FingerStep& step, double before_m, bool was_free);
/// Whether a place is deeper than that.
inline bool is_unentered(const FingerStep& step, double depth_m, double before_m, bool was_free) {
  return depth_m > deepest_entered_m(step, before_m, was_free);
}

/// Whether a finger that was so deep in something can't have left it since the last tick.
bool is_pressed(const FingerStep& step, double before_m);

/// Whether the finger can have come out, since the last tick, of a place that it doesn't touch now.
bool came_out(const FingerStep& step, double depth_m);

/// A deeper place takes over, if one was found that was entered. True where it did.
bool decide_rival(const ContactContext& context, const RivalResult& rival, double tracked_depth_m,
                  const TrackedPlane& kept, DecidedContact& decided);

/// The deepest of the `touched` places takes over, if it is below that rank, or if the finger has left the rendered one
/// there; that goes among them. True where it did.
bool decide_touched(ContactContext& context, double bound_m, TouchedContacts& touched, const TrackedPlane& kept,
                    DecidedContact& decided);

/// Where the finger was put somewhere: what was found there takes over from the followed one, if it is deeper. True
/// where it did.
bool decide_deeper_start(const ContactContext& context, const SeedResult& seeded, const TrackedPlane& kept,
                         DecidedContact& decided);

/// Where following failed: the seeded contact, or the lost one where seeding did no better.
void decide_start(const SeedResult& seeded, const TrackedPlane& kept, DecidedContact& decided);

}  // namespace tangent
