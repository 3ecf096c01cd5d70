// A search for a front as a search program sees it: points in the unit cube, evaluated many at once. Between the
// program and the module that has pagmo (nsga2/), which is loaded only when a front is searched: pagmo and what it
// needs take 35 MB and 40 ms to load.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tangent::sweep {

struct BatchProblem {
  std::size_t dimensions = 0, objectives = 0;
  std::uint64_t seed = 1;
  std::vector<std::vector<double>> start;                                       ///< at least 8, a multiple of 4
  std::vector<double> values;                                                   ///< what `evaluate` gave for them
  std::function<std::vector<double>(const std::vector<double>& all)> evaluate;  ///< point by point, all to be small
  std::function<std::size_t()> left;                                            ///< evaluations that may still be made
};

/// Evolves `start` for as long as a whole generation may be evaluated. What the module exports, as "tangent_nsga2".
using SearchFront = void (*)(const BatchProblem& problem);

}  // namespace tangent::sweep
