// How the processor rounds, while the library computes: to the nearest, denormal numbers kept, nothing trapped. A
// program that is linked with -ffast-math, or loads a library that was, runs with denormal numbers flushed to zero; one
// may round upwards, or trap divisions by zero. None of that may change a tick.
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace tangent {

/// While it lives, this thread computes as the library was tested; then as before. Costs a tick two instructions where
/// nothing is to be changed. On other processors than x86-64 it does nothing.
class FloatState {
 public:
#if defined(__x86_64__)
  FloatState() : before_(_mm_getcsr()), changed_((before_ & ~kHappened) != kTested) {
    if (changed_) [[unlikely]]
      _mm_setcsr(kTested);
  }
  ~FloatState() {
    if (changed_) [[unlikely]]
      _mm_setcsr(before_);
  }

 private:
  static constexpr unsigned kTested = 0x1f80;    // every exception masked, to the nearest, nothing flushed
  static constexpr unsigned kHappened = 0x003f;  // flags of exceptions that happened: they change no result
  unsigned before_;
  bool changed_;

 public:
#else
  FloatState() {}
#endif
  FloatState(const FloatState&) = delete;
  FloatState& operator=(const FloatState&) = delete;
};

}  // namespace tangent
