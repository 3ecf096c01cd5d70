// One tick in words: what became of its contact, how many new planes each of its attempts took, and the limit that
// holds for each.
#pragma once

#include "core/contact/trace.h"
#include "core/tick/tick.h"

#include <cstddef>
#include <span>
#include <string>

namespace tangent {

/// "face, switch, searching": status and event, and whether the search for deeper places goes on at the next tick.
std::string outcome_text(const TickOutput& output);

/// "Tracking 50, seeds 34 + 47, searched 3; limit 50 per attempt". `lost`: records that did not fit into the trace;
/// `planes`: new planes of the whole tick, those of places that were only looked at included.
std::string attempts_text(std::span<const IterationRecord> iterations, std::size_t lost, int planes, int limit);

}  // namespace tangent
