// A few numbers side by side, so that one instruction works on all: the same bits as one by one.
#pragma once

#include <cstdint>

namespace tangent {

using Two = double __attribute__((vector_size(16)));
using Four = float __attribute__((vector_size(16)));
using FourMask = std::int32_t __attribute__((vector_size(16)));  ///< of a comparison: -1 where it holds, else 0

inline Four max(const Four& a, const Four& b) { return a > b ? a : b; }

}  // namespace tangent
