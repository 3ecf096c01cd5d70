#include "core/contact/decide/decide.h"

#include "core/base/tolerances.h"

#include <algorithm>

namespace tangent {
namespace {

void adopt(const IterationResult& contact, const TrackedPlane& kept, DecidedContact& decided) {
  if (contact.plane.triangle != kept.triangle) decided.triangle_changes = std::max(1, decided.triangle_changes);
  decided.contact = contact;
}

}  // namespace

void decide_followed(Followed followed, bool first, DecidedContact& decided) {
  decided.event = followed == Followed::branched ? TickEvent::branch : TickEvent::none;
  decided.evaluations = first ? 0 : decided.contact.evaluations;
  decided.triangle_changes = first ? 0 : decided.contact.triangle_changes;
}

bool was_entered(const ContactContext& context, double depth_m, double tracked_depth_m) {
  if (context.moved_m > context.hystereses_m(kLeapOfFinger)) return true;
  const double explained = 2.0 * context.moved_m + context.hystereses_m(1.0 + kEnteredDepth);
  return depth_m <= std::max(0.0, tracked_depth_m) + explained;
}

bool is_unentered(const ContactContext& context, double depth_m, double before_m) {
  return context.moved_m <= context.hystereses_m(kLeapOfFinger) &&
         depth_m > std::max(0.0, before_m) + context.hystereses_m(kLeapOfFinger);
}

bool decide_rival(const ContactContext& context, const RivalResult& rival, double tracked_depth_m,
                  const TrackedPlane& kept, DecidedContact& decided) {
  decided.evaluations += rival.evaluations;
  if (!rival.deeper) return false;
  if (!was_entered(context, rival.best.contact.penetration_m, tracked_depth_m)) return false;
  adopt(rival.best, kept, decided);
  decided.event = TickEvent::switched;
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
