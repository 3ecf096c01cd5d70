// The attempts of one tick in words: how many new planes each of them took, and the limit that holds for each.
#pragma once

#include "core/contact/trace.h"

#include <cstddef>
#include <span>
#include <string>

namespace tangent {

/// "Tracking 50, seeds 34 + 47, searched 3; limit 50 per attempt". `lost`: records that did not fit into the trace;
/// `planes`: new planes of the whole tick, those of places that were only looked at included.
std::string attempts_text(std::span<const IterationRecord> iterations, std::size_t lost, int planes, int limit);

}  // namespace tangent
