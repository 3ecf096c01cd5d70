#include "core/contact/search/rivals.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"
#include "core/contact/follow/follow.h"
#include "core/contact/prove/clearance_check.h"
#include "core/contact/search/rival_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

/// A search in the tick's context, from the pose that it began at.
struct BegunSearch {
  const Clearance& begun;
  FingerPose pose{begun.centre, begun.orientation};
  ContactContext context;
  IterationResult tracked;

  BegunSearch(const ContactContext& now, const Clearance& from)
      : begun(from), context{now.cache, now.settings, now.finger, pose, now.origin} {
    context.moved_m = now.moved_m;
    context.moved = now.moved;
    context.late_m = now.late_m;
  }
  BegunSearch(const BegunSearch&) = delete;
  BegunSearch& operator=(const BegunSearch&) = delete;

  /// Leads the tracked contact back there. False: it is another one there.
  bool track(const TrackedPlane& plane) {
    lead(context, plane, tracked);
    return tracked.converged() && glm::dot(tracked.plane.normal, plane.normal) >= kJumpCosine;
  }

  RivalResult go_on(const SearchStructures& search, const TouchedContacts* touched, int& work) {
    RivalResult found;
    found.clearance = begun;
    const RivalQuestion question{begun.ahead_height_m, begun.margin_m, false, touched};
    const double closing = std::isfinite(begun.height_m) ? 1.0 : 2.0;
    RivalSearch rest(context, search, tracked, question, closing, begun.ahead, begun.any_turn != 0);
    rest.go_on(found);
    work = rest.work();
    return found;
  }
};

/// Leads to the tick's pose what a search found from another.
void lead_here(const ContactContext& context, const RivalResult& found, double bound_m, RivalResult& result) {
  ContactContext here = context;
  here.trace = nullptr;
  const auto counts = [&](const TrackedPlane& plane, IterationResult& r) {
    lead(here, plane, r);
    result.evaluations += r.evaluations;
    return r.converged() && contact_rank(context.finger, r.contact) < bound_m;
  };
  result.deeper = found.deeper && counts(found.best.plane, result.best);
  for (const TouchedContact& c : found.touched.all()) {
    IterationResult r;
    if (counts(c.plane, r) && pushes_with_others(r.contact)) {
      result.touched.add({r.plane, r.contact}, kMergedPlaces * context.settings.tolerance_m);
    } else {
      forget_surroundings(result.clearance);
    }
  }
}

/// Goes on with a search that is under way. False: it is of no use any more.
bool go_on(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
           const RivalQuestion& question, const Clearance& begun, const Gone& gone, RivalResult& result, int& work) {
  if (gone.now_m > begun.margin_m) return false;
  BegunSearch there(context, begun);
  const bool same = there.track(tracked.plane);
  result.evaluations += there.tracked.evaluations;
  if (!same) return false;
  const RivalResult found = there.go_on(search, question.touched, work);
  result.evaluations += found.evaluations;
  result.clearance = found.clearance;
  result.searching = found.searching;
  lead_here(context, found, question.bound_m, result);
  return true;
}

}  // namespace

double look_ahead_m(const ContactContext& context, double rank, double ahead) {
  const double wanted = context.hystereses_m(kWatchReach) * ahead;
  const double ticks = std::min(kWatchTicks, kDearTicks + ahead * (kWatchTicks - kDearTicks));
  return std::max(ticks_ahead_m(rank, context.moved_m, ticks), 2.0 * context.moved_m < wanted ? wanted : 0.0);
}

RivalResult find_rival(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
                       const RivalQuestion& question, const Clearance& known, const Gone& gone) {
  RivalResult result;
  Clearance last = known;
  int work = 0;
  if (known.under_way && go_on(context, search, tracked, question, known, gone, result, work)) {
    if (result.searching || !deeper_possible(result.clearance, context.pose, gone.now_m, question.bound_m))
      return result;
    last = result.clearance;
  }
  const bool everything = last.under_way || is_beyond(last, context.pose, gone.now_m, question.bound_m);
  // A finger that has not turned since the last search of everything, as most devices measure none, is taken not to.
  const bool any_turn = last.orientation != context.pose.orientation || (!everything && last.any_turn != 0);
  // Proofs about the watched triangles have to hold as far as that of all others.
  const bool stays = everything ? question.bound_stays : std::isfinite(last.height_m);
  RivalSearch rivals(context, search, tracked, question, stays ? 1.0 : 2.0, last.ahead, any_turn, work);
  if (result.deeper) rivals.is_deeper_than(result.best);
  if (everything) {
    result.clearance = Clearance{};
    result.clearance.centre = context.pose.position;
    result.clearance.orientation = context.pose.orientation;
    rivals.everywhere(result);
  } else {
    result.clearance = last;
    recentre(result.clearance, context.pose, gone.now_m);
    rivals.once_more(gone, result);
  }
  return result;
}

}  // namespace tangent
