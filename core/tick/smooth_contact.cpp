#include "core/tick/smooth_contact.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/follow_touched.h"
#include "core/contact/prove/clearance_check.h"
#include "core/tick/walls.h"

#include <algorithm>
#include <limits>

namespace tangent {
namespace {

Gone gone_to(const ContactContext& context, const TickState& state, double gone) {
  const FingerPose before{context.pose.position - context.moved, state.last_orientation};
  return {gone, gone_m(state.clearance, context.finger, before)};
}

/// Asks whether another place can be deeper than the followed contact, and only then looks.
void watch_others(ContactContext& context, const SearchStructures& search, TickState& state, DecidedContact& decided) {
  const double rank = contact_rank(context.finger, decided.contact.contact);
  const Takeover takeover = takeover_from(context, decided.contact.contact, !state.unentered);
  const double gone = gone_m(state.clearance, context.finger, context.pose);
  if (!deeper_possible(state.clearance, context.pose, gone, takeover.bound_m)) return;
  const double ahead = look_ahead_m(context, rank, state.clearance.ahead);
  const RivalResult rival = find_rival(context, search, decided.contact, {takeover.bound_m, ahead, takeover.stays},
                                       state.clearance, gone_to(context, state, gone));
  decided.searching = rival.searching;
  const double depth = state.unentered ? 0.0 : decided.contact.contact.penetration_m;
  const bool taken_over = decide_rival(context, rival, depth, state.plane, decided);
  state.clearance = taken_over ? Clearance{} : rival.clearance;
  if (taken_over) state.unentered = 0;
}

/// Depth of the last converged plane at the present pose, m; 0 where there is none or it was not touched.
double depth_before(const ContactContext& context, const TickState& state) {
  if (!state.has_converged || state.unentered) return 0.0;
  const ConvergedPlane& last = state.last_converged;
  return contact_on_plane(context.finger, context.pose, last.point, last.normal).penetration_m;
}

bool found_before(const TickState& state) { return state.has_converged && state.last_converged_s >= state.last_t_s; }

/// Until one was found where the finger was put, places count as entered as at a first tick ...
bool is_starting(const ContactContext& context, const TickState& state) {
  return state.start != Start::found && context.settings.method == Method::robust;
}
/// ... but for those that the centre is so far behind: where that tick found none, behind an open sheet, say, a later
/// one does not push from there.
double most_behind_m(const ContactContext& context) { return context.hystereses_m(kLeapOfFinger); }

/// Whether the finger is taken to be still inside a closed body: it is deep in the plane that converged last, a moment
/// ago, and near its place.
bool is_inside(const ContactContext& context, const TickState& state) {
  if (context.settings.method != Method::robust || !context.cache.mesh().is_body()) return false;
  const bool lately = state.has_converged && state.last_t_s - state.last_converged_s <= kInsideFor;
  if (!lately || state.unentered) return false;
  FingerStep step = step_of(context);
  step.late_m = 0.0;  // the plane is asked at the present pose
  const ConvergedPlane& last = state.last_converged;
  const PlaneContact now = contact_on_plane(context.finger, context.pose, last.point, last.normal);
  const double near = context.hystereses_m(kLeapOfFinger) + context.finger.unroundness_m();
  return is_pressed(step, now.penetration_m) && now.error_m < near;
}

/// Whether a place is unentered at which the contact leapt or started anew.
bool is_unentered(ContactContext& context, const TickState& state, const IterationResult& found, int& evaluations) {
  if (is_starting(context, state)) return !found_before(state) && found.contact.height_m < -most_behind_m(context);
  const double before = std::max(depth_before(context, state), deepest_m(context, state.touched, evaluations));
  const bool was_free = found_before(state) && !(before > 0.0);
  return is_unentered(step_of(context), found.contact.penetration_m, before, was_free);
}

/// Where every touched place pushes: the rank below which another place is one of them. The finger touches what ranks
/// below its reach; where there is no room for more, only deeper places than those count.
double touching_bound_m(const ContactContext& context, const TouchedContacts& touched) {
  const Finger& finger = context.finger;
  if (touched.full()) return takeover_bound_m(context.settings, contact_rank(finger, touched.shallowest().contact));
  return is_round(finger) ? round_radius_m(finger) : finger.reach_m();
}

/// Adds those of the touched places that were `found` that count: they were entered, are not the far side of what the
/// finger is in, and can be followed; `depth`: of what is known. How far the finger goes at least before one that does
/// not count may do so, m; infinity where all do.
double add_what_counts(ContactContext& context, const TouchedContacts& found, double depth, bool unentered,
                       DecidedContact& decided, TouchedContacts& touched) {
  const FingerStep step = step_of(context);
  const TouchedContact tracked{decided.contact.plane, decided.contact.contact};
  const bool has_far_side = !unentered && !was_put_elsewhere(step);
  const double least = unentered || (!is_round(context.finger) && tracked.contact.height_m < 0.0)
                           ? -context.hystereses_m(kLeftTouch)
                           : -std::numeric_limits<double>::infinity();
  double refused_for = std::numeric_limits<double>::infinity();
  for (const TouchedContact& c : found.all()) {
    const double deep = c.contact.penetration_m;
    const bool counts = deep >= least && was_entered(step, deep, depth) && !(has_far_side && is_far_side(c, tracked)) &&
                        can_be_followed(context, c, decided.evaluations);
    if (counts) {
      touched.add(c, kMergedPlaces * context.settings.tolerance_m);
    } else {
      const double nearer = least - deep;  // a depth changes by no more than the finger moves
      refused_for = std::min(refused_for, std::max(nearer, unentered_for_m(step, deep, depth)));
    }
  }
  return refused_for;
}

/// Looks for places that are touched and not followed yet. True where a deeper one that does not push with others, of a
/// rank below `deeper_m`, takes over.
bool look_for_touched(ContactContext& context, const SearchStructures& search, const Takeover& takeover,
                      double deeper_m, TickState& state, DecidedContact& decided, TouchedContacts& touched) {
  const double bound = std::max(takeover.bound_m, touching_bound_m(context, touched));
  const double gone = gone_m(state.clearance, context.finger, context.pose);
  if (!deeper_possible(state.clearance, context.pose, gone, bound)) return false;
  const double rank = contact_rank(context.finger, decided.contact.contact);
  const double ahead = look_ahead_m(context, rank, state.clearance.ahead);
  const bool stays = takeover.stays || (bound > takeover.bound_m && !touched.full());
  RivalResult rival = find_rival(context, search, decided.contact, {bound, ahead, stays, &touched}, state.clearance,
                                 gone_to(context, state, gone));
  state.clearance = rival.clearance;
  decided.searching = rival.searching;
  // Where the contact was lost and a shallower one is gone on with, what the lost one was counts, too; so do the
  // others.
  const bool found = rival.deeper || rival.touched.count > 0;
  const double depth =
      std::max({depth_before(context, state), state.unentered ? 0.0 : decided.contact.contact.penetration_m,
                found ? deepest_m(context, state.touched, decided.evaluations) : 0.0});
  const std::size_t followed = touched.count;
  const double refused_for = add_what_counts(context, rival.touched, depth, state.unentered, decided, touched);
  if (refused_for < std::numeric_limits<double>::infinity())
    forget_surroundings(state.clearance, gone_m(state.clearance, context.finger, context.pose), refused_for);
  if (touched.count > followed || touched.full()) decided.places_changed = true;
  rival.deeper = rival.deeper && !pushes_with_others(rival.best.contact) &&
                 contact_rank(context.finger, rival.best.contact) < deeper_m;
  if (!decide_rival(context, rival, depth, state.plane, decided)) return false;
  state.clearance = Clearance{};
  state.unentered = 0;
  return true;
}

/// Where every touched place pushes: follows them all and `looks` for more; the deepest is the one to render on the
/// display.
void watch_touched(ContactContext& context, const SearchStructures& search, bool looks, TickState& state,
                   DecidedContact& decided, TouchedContacts& touched) {
  if (state.touched.count > 0) {
    const FollowedPlaces followed =
        follow_touched(context, state.touched, &decided.contact.plane, touched, decided.evaluations);
    // What leads to a place that is followed no more was not looked at.
    bool known = !followed.lost;
    for (std::uint32_t i = 0; known && i < followed.left.count; ++i)
      known = watch_again(state.clearance, context.cache.mesh(), followed.left.places[i]);
    if (!known) state.clearance = Clearance{};
    decided.places_changed = followed.lost || followed.left.count > 0 || followed.merged || followed.folded;
  }
  const PlaneContact& tracked = decided.contact.contact;
  // What it is behind of, of a closed body, the finger may leave at a place that is hardly nearer, as at a thin edge.
  const bool behind = !pushes_with_others(tracked) && context.cache.mesh().is_body();
  const Takeover takeover = takeover_from(context, tracked, false, tracked.penetration_m > 0.0 ? kTremor : 1.0);
  const Takeover nearer = behind ? takeover_from(context, tracked, false) : takeover;
  if (looks && look_for_touched(context, search, nearer, takeover.bound_m, state, decided, touched)) return;
  if (state.unentered) return;
  if (!is_behind_in_inner_edge(context, decided.contact, touched))
    decide_touched(context, takeover.bound_m, touched, state.plane, decided);
  if (can_lack_walls(context.cache.mesh(), context.finger, context.pose.position, decided.contact.plane, state.touched))
    add_walls(context, search.nearest, state.touched, state.plane, decided, touched);
}

/// Where following failed: the deepest of the other places that are touched, if there is one, is the one to go on with.
bool go_on_with_touched(ContactContext& context, TickState& state, DecidedContact& decided, TouchedContacts& touched) {
  if (state.touched.count == 0) return false;
  follow_touched(context, state.touched, nullptr, touched, decided.evaluations);
  const double reach = is_round(context.finger) ? round_radius_m(context.finger) : context.finger.reach_m();
  const bool found = decide_touched(context, reach, touched, state.plane, decided);
  touched.count = 0;  // they are followed again beside the new one
  return found || go_on_with_wall(context, state.touched, decided);
}

/// Where a lost contact may be gone on with.
EnteredPlaces entered_places(ContactContext& context, const TickState& state, int& evaluations) {
  const FingerStep step = step_of(context);
  EnteredPlaces entered;
  if (is_starting(context, state)) {
    entered.behind_m = most_behind_m(context);
    return entered;
  }
  const double before = depth_before(context, state);
  const double deepest = std::max(before, deepest_m(context, state.touched, evaluations));
  entered.inside = is_inside(context, state);
  entered.pressed = entered.inside || is_pressed(step, deepest);
  entered.deepest_m = deepest_entered_m(step, deepest, found_before(state) && !(deepest > 0.0));
  if (!(before > 0.0) || was_put_elsewhere(step)) return entered;
  entered.most_slide_m = std::max(context.hystereses_m(kLeapOfFinger), context.finger.reach_m());
  TouchedContact& last = entered.last.emplace();
  last.plane.point = state.last_converged.point;
  last.plane.normal = state.last_converged.normal;
  last.contact = contact_on_plane(context.finger, context.pose, state.last_converged.point, last.plane.normal);
  return entered;
}

/// Where following failed. `begins`: a first tick, or one after a leap.
void start_anew(ContactContext& context, const SearchStructures& search, bool begins, const EnteredPlaces& entered,
                TickState& state, DecidedContact& decided) {
  const bool in_vain = !begins && !found_before(state);  // not where there was no search at all, as in an unready tick
  if (!in_vain) state.clearance = Clearance{};
  const bool in_parts = begins || state.has_previous;
  const SeedResult seeded =
      seed_contact(context, search, state.plane, in_vain, in_parts ? &state.clearance : nullptr, entered);
  decided.searching = seeded.searching;
  const double depth = seeded.best.contact.penetration_m;
  const bool left = !seeded.searching && !(depth > 0.0) && came_out(step_of(context), depth);
  const bool goes_on = left || entered.go_on_at(seeded.best.plane, seeded.best.contact);
  if ((seeded.searching || entered.inside) && seeded.best.converged() && !goes_on) {
    // Where the search is not through, the place that the finger came into may be still to come; inside a body it may
    // come up again.
    decided.evaluations += seeded.evaluations;
    decided.contact.stop = StopReason::facing;
    decided.event = TickEvent::reseed;
    return;
  }
  decide_start(seeded, state.plane, decided);
  if (decided.converged() && !(begins && seeded.searching)) state.clearance = Clearance{};
}

/// Where the followed contact has leapt into what was not entered: back to what was. False: there is none, or the
/// search would take longer than a tick.
bool go_back_to_entered(ContactContext& context, const SearchStructures& search, TickState& state,
                        DecidedContact& decided, TouchedContacts* touched) {
  if (context.settings.method != Method::robust) return false;
  if (touched && go_on_with_touched(context, state, decided, *touched)) return true;
  const EnteredPlaces entered = entered_places(context, state, decided.evaluations);
  Clearance parts;
  const SeedResult seeded = seed_contact(context, search, state.plane, false, &parts, entered);
  if (seeded.best.converged() && entered.go_on_at(seeded.best.plane, seeded.best.contact)) {
    decide_start(seeded, state.plane, decided);
    return true;
  }
  decided.evaluations += seeded.evaluations;
  return false;
}

/// A finger that has been put elsewhere starts at the deepest place there, unless that is the one that was followed.
/// True where it did.
bool start_after_leap(ContactContext& context, const SearchStructures& search, TickState& state,
                      DecidedContact& decided) {
  if (context.settings.method != Method::robust) return false;
  Clearance begun;
  const SeedResult seeded = seed_contact(context, search, state.plane, false, &begun);
  decided.searching = seeded.searching;
  const bool started = decide_deeper_start(context, seeded, state.plane, decided);
  if (started || seeded.searching) state.clearance = begun;
  if (started) state.unentered = 0;
  return started;
}

/// A first search that is not through goes on. `found`: there is a contact already.
void go_on_starting(ContactContext& context, const SearchStructures& search, bool found, TickState& state,
                    DecidedContact& decided) {
  const SeedResult seeded = go_on_with_start(context, search, found ? &decided.contact : nullptr, state.clearance);
  decided.searching = seeded.searching && context.late_m <= context.hystereses_m(kLeapOfFinger);
  if (!decided.searching) state.clearance = Clearance{};
  if (found) {
    if (!decide_deeper_start(context, seeded, state.plane, decided)) return;
    decided.event = TickEvent::switched;
    state.unentered = 0;
  } else if (seeded.found) {
    decide_start(seeded, state.plane, decided);
    state.unentered = 0;
  } else {
    decided.evaluations += seeded.evaluations;
    decided.contact.stop = StopReason::facing;
    decided.event = TickEvent::reseed;
  }
}

/// Of a contact that leapt, or came up after ticks without one: whether it counts, and if not, whether there is one to
/// go back to. True where another is decided on, or none.
bool judge_leapt(ContactContext& context, const SearchStructures& search, bool leapt, TickState& state,
                 DecidedContact& decided, TouchedContacts* touched) {
  const double depth = decided.contact.contact.penetration_m;
  const bool inside = is_inside(context, state);
  const IterationResult& found = decided.contact;
  const auto slid = [&] {
    return inside && entered_places(context, state, decided.evaluations).hold(found.plane, found.contact);
  };
  const bool counts = depth > 0.0 ? !is_unentered(context, state, found, decided.evaluations) || slid()
                                  : !inside || came_out(step_of(context), depth);
  if (counts) return false;
  if ((leapt || inside) && go_back_to_entered(context, search, state, decided, touched)) return true;
  if (inside) {
    // What it is in may come up again.
    decided.contact.stop = StopReason::facing;
    decided.event = TickEvent::reseed;
    return true;
  }
  state.unentered = 1;
  return false;
}

/// The same of the followed contact.
bool judge_followed(ContactContext& context, const SearchStructures& search, Followed followed, TickState& state,
                    DecidedContact& decided, TouchedContacts* touched) {
  if (!(decided.contact.contact.penetration_m > 0.0)) state.unentered = 0;  // left: from now on it counts
  const bool leapt = followed == Followed::branched;
  if (state.unentered || (!leapt && found_before(state))) return false;
  return judge_leapt(context, search, leapt, state, decided, touched);
}

/// Where a first search stands now. `begins`: it began in this tick.
Start start_after(bool begins, Start before, const DecidedContact& decided) {
  if ((begins || before == Start::searching) && decided.searching) return Start::searching;
  if (decided.converged()) return Start::found;
  return begins || before == Start::searching ? Start::in_vain : before;
}

/// The place to render, but for others that are deeper: the followed one, or what is found where it was lost or the
/// finger starts. True where it is followed on.
bool follow_or_start(ContactContext& context, const SearchStructures& search, bool sample_is_kept, TickState& state,
                     DecidedContact& decided, TouchedContacts* touched) {
  const bool first = state.plane.feature == Feature::none, leapt = was_put_elsewhere(step_of(context));
  const bool robust = context.settings.method == Method::robust;  // until now the method may have been another
  if (first || leapt || (state.start == Start::searching && !robust)) state.start = Start::found;
  const Followed followed = first ? Followed::lost : follow(context, state.plane, sample_is_kept, decided.contact);
  decide_followed(followed, first, decided);
  bool follows = followed != Followed::lost && !(leapt && start_after_leap(context, search, state, decided));
  if (follows && judge_followed(context, search, followed, state, decided, touched)) {
    state.clearance = Clearance{};
    follows = false;
  }
  if (state.start == Start::searching) {
    go_on_starting(context, search, followed != Followed::lost, state, decided);
  } else if (followed == Followed::lost) {
    if (touched && go_on_with_touched(context, state, decided, *touched)) {
      state.clearance = Clearance{};
      state.unentered = 0;
      decided.searching = leapt && robust;  // not yet where it was put
    } else {
      const EnteredPlaces entered = first ? EnteredPlaces{} : entered_places(context, state, decided.evaluations);
      start_anew(context, search, first || leapt, entered, state, decided);
      if (!decided.facing())  // there, nothing could be entered
        state.unentered = !entered.hold(decided.contact.plane, decided.contact.contact);
    }
  }
  state.start = start_after(first || leapt, state.start, decided);
  return follows;
}

/// On the way to the next tick. `lost_depth_m`: by how much what is gone on with is less deep than what was lost.
void remember_way(const ContactContext& context, double lost_depth_m, bool searching, TickState& state) {
  state.late_m = state.lost_m = 0.0f;
  if (!searching && !(context.lost_m > 0.0) && !(lost_depth_m > 0.0)) return;
  const bool elsewhere = was_put_elsewhere(step_of(context));
  state.late_m = searching && !elsewhere ? static_cast<float>(context.late_m + context.moved_m) : 0.0f;
  const double most = context.hystereses_m(kMostLateEntry);
  double lost = context.lost_m > 0.0 ? context.lost_m + context.moved_m : 0.0;
  if (lost > most && !searching) lost = 0.0;
  // Places count as deeper by twice the way.
  if (lost_depth_m > 0.0) lost = std::min(std::max(lost, 0.5 * lost_depth_m), most);
  state.lost_m = elsewhere ? 0.0f : static_cast<float>(lost);
}

}  // namespace

void find_smooth_contact(ContactContext& context, const SearchStructures& search, bool sample_is_kept, TickState& state,
                         DecidedContact& decided, TouchedContacts* touched) {
  context.late_m = double{state.late_m};
  context.lost_m = double{state.lost_m};
  decided.searching = decided.places_changed = false;
  if (!touched && state.touched.count > 0) {  // they were followed until now, and are looked for no more
    state.touched.count = 0;
    state.clearance = Clearance{};
  }
  const double before = depth_before(context, state);
  const bool follows = follow_or_start(context, search, sample_is_kept, state, decided, touched);
  const bool watches = state.start != Start::searching;  // else the tick has done enough
  if (touched) {
    touched->count = 0;
    touched->with_walls = false;
    const bool looks = decided.event != TickEvent::reseed;
    if (watches && decided.converged()) watch_touched(context, search, looks, state, decided, *touched);
    if (touched->count > 0 || state.touched.count > 0) state.touched = touched->places();
  } else if (watches && follows) {
    watch_others(context, search, state, decided);
  }
  const double lost_depth = follows ? 0.0 : before - std::max(0.0, decided.contact.contact.penetration_m);
  remember_way(context, lost_depth, decided.searching, state);
}

}  // namespace tangent
