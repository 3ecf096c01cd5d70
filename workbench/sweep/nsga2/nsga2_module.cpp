// NSGA-II of pagmo, as a module of its own (batch_problem.h says why).
#include "workbench/sweep/batch_problem.h"

#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include <utility>

namespace tangent::sweep {
namespace {

/// As pagmo wants a problem: it copies it, so the problem itself is elsewhere.
struct UnitCube {
  const BatchProblem* problem = nullptr;

  std::size_t get_nobj() const { return problem->objectives; }
  std::pair<std::vector<double>, std::vector<double>> get_bounds() const {
    return {std::vector<double>(problem->dimensions, 0.0), std::vector<double>(problem->dimensions, 1.0)};
  }
  std::vector<double> fitness(const std::vector<double>& point) const { return problem->evaluate(point); }
  std::vector<double> batch_fitness(const std::vector<double>& all) const { return problem->evaluate(all); }
};

pagmo::population population_of(const BatchProblem& problem) {
  pagmo::population out(pagmo::problem(UnitCube{&problem}), 0u, static_cast<unsigned>(problem.seed));
  for (std::size_t i = 0; i < problem.start.size(); ++i) {
    const auto begin = problem.values.begin() + static_cast<std::ptrdiff_t>(i * problem.objectives);
    out.push_back(problem.start[i], {begin, begin + static_cast<std::ptrdiff_t>(problem.objectives)});
  }
  return out;
}

}  // namespace
}  // namespace tangent::sweep

extern "C" [[gnu::visibility("default")]] void tangent_nsga2(const tangent::sweep::BatchProblem& problem) {
  pagmo::population population = tangent::sweep::population_of(problem);
  for (unsigned generation = 0; problem.left() >= problem.start.size(); ++generation) {
    pagmo::nsga2 search(1, 0.9, 15.0, 1.0 / static_cast<double>(problem.dimensions), 20.0,
                        static_cast<unsigned>(problem.seed) + generation);
    search.set_bfe(pagmo::bfe(pagmo::member_bfe{}));
    population = search.evolve(population);
  }
}
