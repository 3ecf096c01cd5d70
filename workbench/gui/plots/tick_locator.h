// Positions and labels of an axis's ticks.
#pragma once

#include <string>
#include <vector>

namespace tangent {

struct AxisTick {
  double value = 0.0;
  bool major = true;  ///< labelled, stronger grid line
  std::string label;  ///< empty for minor ticks
};

/// The smallest step of 1, 2 or 5 times a power of ten with at most `most` steps over the range.
/// Precondition: range > 0, most >= 1.
double nice_step(double range, int most);

/// Multiples of nice_step inside [low, high], with four or five minor ticks per step. Labels have as many decimals as
/// the step needs; -0 is written 0.
std::vector<AxisTick> linear_ticks(double low, double high, int most_labels);

/// Powers of ten inside [low, high] (both > 0), labelled "1", "0.01", "1e-6", at most about `most_labels` of
/// them; minor ticks at 2..9 where every decade is labelled.
std::vector<AxisTick> log_ticks(double low, double high, int most_labels);

/// Either kind, for an axis that has room for `lines` lines of text. Where that gives fewer than two labels, the first
/// and the last label of a finer division, if they are a line apart. `whole`: only whole numbers have labels.
struct ValueTicks {
  double low = 0.0, high = 1.0;
  bool log = false, whole = false;
  double lines = 4.0;
};
std::vector<AxisTick> value_ticks(const ValueTicks& axis);

/// [low, high] widened to multiples of a nice step; never empty.
void widen_to_nice(double& low, double& high, int most);

}  // namespace tangent
