// Points none of which is better than another in everything: the front of several objectives, all to be made small.
#pragma once

#include "workbench/sweep/objective.h"

#include <span>
#include <vector>

namespace tangent::sweep {

struct Trial {
  std::vector<double> values;               ///< one a range, as tried
  CellNumbers numbers;                      ///< of the first ground; circles only where an objective or constraint asks
  std::vector<CellNumbers> ground_numbers;  ///< of all
  std::vector<double> objectives;
  double missed = 0.0;    ///< sum over the constraints of how far each is missed; 0: all hold
  std::size_t ticks = 0;  ///< that it saw
  bool dropped = false;   ///< it saw a part of them, which showed that it is on no front: its numbers are of that part
};

/// a is at least as good as b in everything, and better in something: missed constraints first.
bool dominates(const Trial& a, const Trial& b);

/// Indices of the trials that no other dominates, in order of the first objective; of equals the first. Empty only
/// without trials.
std::vector<std::size_t> front_of(std::span<const Trial> trials);

/// The front's point nearest to the best of every objective, each scaled to the front's extent: where giving up more
/// of one gains little of another. Precondition: front not empty.
std::size_t balanced(std::span<const Trial> trials, std::span<const std::size_t> front);

/// Whether a is better than b by more than `share` in some objective and worse by that in none.
bool clearly_better(const Trial& a, const Trial& b, double share);

}  // namespace tangent::sweep
