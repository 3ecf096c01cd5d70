// The force of the last seconds in even steps, fed tick by tick: the largest of each step.
#pragma once

#include <cstdint>
#include <vector>

namespace tangent {

class ForceTrace {
 public:
  explicit ForceTrace(double length_s = 10.0, std::size_t steps = 500);
  /// Times grow; one that goes back begins anew.
  void add(double t_s, double force_n);
  /// Oldest first, up to the newest step; as many as `steps`, 0 where there was no tick.
  std::vector<float> values() const;
  double length_s() const { return step_s_ * static_cast<double>(ring_.size()); }

 private:
  double step_s_;
  std::vector<float> ring_;
  std::int64_t newest_ = -1;  ///< step
};

}  // namespace tangent
