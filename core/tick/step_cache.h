// What a stepper keeps between ticks beside the state; it can always be computed again from that, so an empty one
// gives the same bits, later.
#pragma once

#include "core/contact/decide/decide.h"

namespace tangent {

class StepCache {
 public:
  explicit StepCache(const ContactMesh& mesh) : patches(mesh) {}

  /// Whether `smooth` still holds the sample of this kept plane: the same place on a face or an edge, bit for bit.
  bool holds(const TrackedPlane& kept, NormalForm kept_form) const {
    const TrackedPlane& mine = smooth.contact.plane;
    if (kept.feature != mine.feature || kept.triangle != mine.triangle || kept.u != mine.u || kept.v != mine.v ||
        kept_form != form)
      return false;
    return kept.feature == Feature::face || (kept.feature == Feature::edge && kept.side == mine.side &&
                                             kept.turn == mine.turn && kept.normal == mine.normal);
  }

  PatchCache patches;
  DecidedContact smooth;    ///< of the last tick
  TouchedContacts touched;  ///< beside it; room for one tick, nothing is read of the last
  NormalForm form = NormalForm::bernstein;
};

}  // namespace tangent
