// Variations of one tick, solved to see what they change.
#pragma once

#include "core/lab/explain/explain_tick.h"

#include <span>

namespace tangent {

/// A tick as it was given. What is referred to must outlive it.
struct GivenTick {
  const Preset& preset;
  const TickInput& input;
  const TickState& before;
  const ExplainOptions& options;
};

/// Solves variations of it.
class TickTrials : public GivenTick {
 public:
  TickTrials(std::shared_ptr<const ContactScene> scene, const GivenTick& given)
      : GivenTick(given), stepper_(std::move(scene)) {}

  /// With another preset. Fills `trace`, if given.
  TickOutput solve(const Preset& changed, IterationTrace* trace = nullptr) {
    TickState state = before;
    return step(changed, input, state, trace);
  }
  TickOutput step(const Preset& changed, const TickInput& to, TickState& state, IterationTrace* trace = nullptr) {
    if (trace) trace->clear();
    ++solves;
    return stepper_.step(changed, to, state, trace);
  }
  /// Nothing is left to be explained. Where nothing was tracked before, the event `first` is none.
  bool plain(const TickOutput& out, bool first = false) const {
    const bool no_event = out.event == TickEvent::none || (first && out.event == TickEvent::first);
    return is_converged(out.status) && no_event && out.iterations <= options.many_planes;
  }
  bool is_first() const { return before.plane.feature == Feature::none; }
  bool cured(const Preset& changed) { return plain(solve(changed), is_first()); }
  const ContactScene& scene() const { return stepper_.scene(); }
  const ContactMesh& mesh() const { return stepper_.scene().mesh(); }

  int solves = 0;

 private:
  Stepper stepper_;
};

/// The planes of the first run of a traced tick: of following the kept plane, or of the first seed. Empty: none.
inline std::span<const IterationRecord> first_run(const IterationTrace& trace) {
  const auto all = trace.view();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].stop != StopReason::going_on) return all.first(i + 1);
  return all;
}

}  // namespace tangent
