// A few numbers side by side, so that one instruction works on all: the same bits as one by one.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace tangent {

using Two = double __attribute__((vector_size(16)));
using Four = float __attribute__((vector_size(16)));
using FourMask = std::int32_t __attribute__((vector_size(16)));  ///< of a comparison: -1 where it holds, else 0

// One instruction each, by the names of GCC's builtins: its header would be installed with this one.
#if defined(__SSE__) && !defined(__clang__)
#define TANGENT_GCC_LANES
#endif

/// Bit i: whether it holds of number i.
inline std::uint32_t bits_of(const FourMask& mask) {
#ifdef TANGENT_GCC_LANES
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<Four>(mask)));
#else
  const auto bit = [&](int i) { return static_cast<std::uint32_t>(mask[i]) & (1u << i); };
  return bit(0) | bit(1) | bit(2) | bit(3);
#endif
}

#ifdef TANGENT_GCC_LANES
inline Four max(const Four& a, const Four& b) { return __builtin_ia32_maxps(a, b); }
inline Four min(const Four& a, const Four& b) { return __builtin_ia32_minps(a, b); }
inline Four sqrt(const Four& x) { return __builtin_ia32_sqrtps(x); }
#else
inline Four max(const Four& a, const Four& b) { return a > b ? a : b; }
inline Four min(const Four& a, const Four& b) { return a < b ? a : b; }
inline Four sqrt(const Four& x) { return Four{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])}; }
#endif
#undef TANGENT_GCC_LANES

/// Four vectors, by coordinates.
using FourVec3 = std::array<Four, 3>;
inline Four dot(const FourVec3& a, const FourVec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline FourVec3 cross(const FourVec3& a, const FourVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// One number four times.
inline Four all_four(double x) { return Four{} + static_cast<float>(x); }

}  // namespace tangent
