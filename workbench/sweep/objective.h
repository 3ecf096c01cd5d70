// What a search for presets is to make small, and what it must keep to: names of the numbers of a cell.
#pragma once

#include "core/base/result.h"
#include "workbench/sweep/cell_numbers.h"

#include <string>
#include <string_view>
#include <vector>

namespace tangent::sweep {

/// A column of CellNumbers, to be made as small as can be.
struct Objective {
  const NumberColumn* column = nullptr;
  std::string_view name() const { return column->name; }
  double of(const CellNumbers& numbers) const;
};
/// Fails on a name that is none, listing those that are.
Result<Objective> find_objective(std::string_view name);

/// "unconverged = 0", "p99_iterations <= 5": a column may not be above a value.
struct Constraint {
  Objective of;
  double most = 0.0;
  bool holds(const CellNumbers& numbers) const { return of.of(numbers) <= most; }
  /// By how much it is missed, as a share of the value where that is above 0; 0: it holds.
  double missed(const CellNumbers& numbers) const;
  std::string text() const;
};
Result<Constraint> parse_constraint(std::string_view text);
/// Fails where two contradict each other in a way that shows: a column below 0.
Status check_constraints(const std::vector<Constraint>& constraints);

}  // namespace tangent::sweep
