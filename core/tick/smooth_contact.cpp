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
  const double ahead = look_ahead_m(context, rank, state.clearance.ahead);
  const RivalResult rival = find_rival(context, search, decided.contact, bound, ahead, state.clearance, gone);
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

}  // namespace

void find_smooth_contact(ContactContext& context, const SearchStructures& search, bool sample_is_kept, TickState& state,
                         DecidedContact& decided) {
  const bool first = state.plane.feature == Feature::none;
  const Followed followed = first ? Followed::lost : follow(context, state.plane, sample_is_kept, decided.contact);
  decide_followed(followed, first, decided);
  if (followed != Followed::lost) {
    if (!(decided.contact.contact.penetration_m > 0.0)) state.unentered = 0;  // left: from now on it counts
    return watch_others(context, search, state, decided);
  }
  state.clearance = Clearance{};
  decide_start(seed_contact(context, search, state.plane), state.plane, decided);
  state.unentered =
      !first && is_unentered(context, decided.contact.contact.penetration_m, depth_before(context, state));
}

}  // namespace tangent
