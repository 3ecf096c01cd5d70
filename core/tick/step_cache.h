// What a stepper keeps between ticks beside the state; it can always be computed again from that, so an empty one
// gives the same bits, later.
#pragma once

#include "core/contact/decide/decide.h"

#include <atomic>

namespace tangent {

/// The one thread that may be in a stepper now. Where the library is built without assertions nothing is looked at, and
/// every thread counts as that one.
class StepperUse {
 public:
#if defined(NDEBUG)
  struct Flag {};
  explicit StepperUse(Flag&) {}
  static constexpr bool mine() { return true; }
#else
  using Flag = std::atomic<bool>;
  explicit StepperUse(Flag& in_use) : in_use_(in_use), mine_(!in_use.exchange(true, std::memory_order_acquire)) {}
  ~StepperUse() {
    if (mine_) in_use_.store(false, std::memory_order_release);
  }
  bool mine() const { return mine_; }

 private:
  Flag& in_use_;
  bool mine_;

 public:
#endif
  StepperUse(const StepperUse&) = delete;
  StepperUse& operator=(const StepperUse&) = delete;
};

class StepCache {
 public:
  explicit StepCache(const ContactMesh& mesh) : patches(mesh) {}

  /// Whether `smooth` still holds the sample of this kept plane: the same place on a face, bit for bit. On an edge the
  /// sample may be the one of the same place seen from its other side, or by another parameter; where a run did not
  /// converge it may be of the place before.
  bool holds(const TrackedPlane& kept, NormalForm kept_form) const {
    const IterationResult& mine = smooth.contact;
    return kept.feature == Feature::face && mine.plane.feature == Feature::face &&
           kept.triangle == mine.plane.triangle && kept.u == mine.plane.u && kept.v == mine.plane.v &&
           kept_form == form && mine.converged();
  }

  PatchCache patches;
  DecidedContact smooth;       ///< of the last tick
  TouchedContacts touched;     ///< beside it; room for one tick, nothing is read of the last
  TouchedPlaces last_touched;  ///< what the last tick left of them; likewise
  NormalForm form = NormalForm::bernstein;
  [[no_unique_address]] StepperUse::Flag in_use{};
};

}  // namespace tangent
