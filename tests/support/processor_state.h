// The ways in which a program may have set up how its processor computes.
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>

namespace tangent::testing {

inline constexpr unsigned kAsTested = 0x1f80;
inline constexpr unsigned kFlushed = 0x9fc0;  // as -ffast-math sets it: denormal numbers are zero, read and written
inline constexpr unsigned kUpwards = 0x5f80;
inline constexpr unsigned kTrapping = 0x1d00;  // invalid operations and divisions by zero raise a signal
inline constexpr unsigned kHappened = 0x003f;  // flags of exceptions that happened

/// The processor's state, put back at the end.
class ProcessorState {
 public:
  explicit ProcessorState(unsigned state) : before_(_mm_getcsr()) { _mm_setcsr(state); }
  ~ProcessorState() { _mm_setcsr(before_); }
  ProcessorState(const ProcessorState&) = delete;
  ProcessorState& operator=(const ProcessorState&) = delete;

 private:
  unsigned before_;
};

}  // namespace tangent::testing
#endif
