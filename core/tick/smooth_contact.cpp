#include "core/tick/smooth_contact.h"

#include "core/contact/prove/clearance_check.h"

namespace tangent {
namespace {

/// Asks whether another place can be deeper than the followed contact, and only then looks.
void watch_others(ContactContext& context, const SearchStructures& search, TickState& state, DecidedContact& decided) {
  const double rank = contact_rank(context.finger, decided.contact.contact);
  const double bound = takeover_bound_m(context.settings, rank);
  const double gone = gone_m(state.clearance, context.finger, context.pose);
  if (!deeper_possible(state.clearance, gone, bound)) return;
  const double ahead = look_ahead_m(rank, context.moved_m);
  const RivalResult rival = find_rival(context, search, decided.contact, bound, ahead, state.clearance, gone);
  const bool taken_over = decide_rival(context, rival, state.plane, decided);
  state.clearance = taken_over ? Clearance{} : rival.clearance;
}

}  // namespace

void find_smooth_contact(ContactContext& context, const SearchStructures& search, bool sample_is_kept, TickState& state,
                         DecidedContact& decided) {
  const bool first = state.plane.feature == Feature::none;
  const Followed followed = first ? Followed::lost : follow(context, state.plane, sample_is_kept, decided.contact);
  decide_followed(followed, first, decided);
  if (followed != Followed::lost) return watch_others(context, search, state, decided);
  state.clearance = Clearance{};
  decide_start(seed_contact(context, search, state.plane), state.plane, decided);
}

}  // namespace tangent
