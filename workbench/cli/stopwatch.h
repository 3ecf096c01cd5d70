// Wall-clock time since construction.
#pragma once

#include <chrono>

namespace tangent {

class Stopwatch {
 public:
  double nanoseconds() const {
    return static_cast<double>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start_).count());
  }
  double seconds() const { return nanoseconds() * 1e-9; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tangent
