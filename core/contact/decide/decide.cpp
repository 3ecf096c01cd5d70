#include "core/contact/decide/decide.h"

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

void decide_rival(const RivalResult& rival, const TrackedPlane& kept, DecidedContact& decided) {
  decided.evaluations += rival.evaluations;
  if (!rival.deeper) return;
  adopt(rival.best, kept, decided);
  decided.event = TickEvent::switched;
}

void decide_start(const SeedResult& seeded, const TrackedPlane& kept, DecidedContact& decided) {
  const bool first = kept.feature == Feature::none;
  decided.evaluations += seeded.evaluations;
  if (seeded.found || first || seeded.best.contact.error_m < decided.contact.contact.error_m)
    adopt(seeded.best, kept, decided);
  decided.event = first ? TickEvent::first : TickEvent::reseed;
}

}  // namespace tangent
