// Many fingers at once, on all cores. Each finger's ticks are a pure function of its own poses, so the bits are those
// of one stepper after the other, whatever the number of threads.
#pragma once

#include "core/tick/step.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace tangent {

/// Solves one finger's path with a stepper of the calling thread, from a state of the finger's own.
using FingerWork = std::function<void(Stepper& stepper, std::size_t finger)>;

/// Calls `work` once for every finger, on at most `threads` threads (0: one per core; never more than eight per core),
/// and returns when all are done.
/// Which thread takes which finger, and when, is not said. What `work` throws is thrown here, when all threads
/// have ended; then fingers may have been left.
void for_each_finger(const std::shared_ptr<const ContactScene>& scene, std::size_t fingers, unsigned threads,
                     const FingerWork& work);

/// Finger f has the poses inputs[f * ticks] to inputs[(f + 1) * ticks - 1], in turn, from a fresh state, and `outputs`
/// in the same places; ticks 1: poses that have nothing to do with each other, each searched to the end in its tick
/// (TickInput::all_at_once). Preconditions: both spans hold fingers * ticks; the preset is within its ranges.
void solve_fingers(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                   std::span<const TickInput> inputs, std::span<TickOutput> outputs, std::size_t fingers,
                   unsigned threads = 0);

}  // namespace tangent
