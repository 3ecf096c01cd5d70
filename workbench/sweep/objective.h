// What a search for presets is to make small, and what it must keep to: names of the numbers of a cell.
#pragma once

#include "core/base/result.h"
#include "workbench/sweep/cell_numbers.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace tangent::sweep {

/// How much longer a tick takes here than its counted work says (tick_work.h): measured over counted, of the mean and
/// of the 99th percentile. 1: not measured.
struct TimeScale {
  double mean = 1.0, p99 = 1.0;
};

/// A column of CellNumbers, to be made as small as can be.
struct Objective {
  const NumberColumn* column = nullptr;
  /// The column's, but mean_time and p99_time for the counted times.
  std::string_view name() const;
  bool is_time() const;
  /// Of errors: the share of ticks without a contact, where it is above a half, and the error of the rest says nothing.
  /// 0: it says something. A preset that fails everywhere has no error that could be measured, and would be the best of
  /// all: whoever lacks so much is taken to miss a constraint by that share.
  double lacking(const CellNumbers& numbers) const;
  /// As counted: the same on any machine.
  double of(const CellNumbers& numbers) const;
  /// As it takes here.
  double of(const CellNumbers& numbers, const TimeScale& scale) const;
};

/// Short names of columns.
struct ObjectiveName {
  std::string_view name, column;
};
inline constexpr std::array kObjectiveNames{
    ObjectiveName{"mean_time", "mean_counted_us"}, ObjectiveName{"p99_time", "p99_counted_us"},
    ObjectiveName{"error", "error_p99_m"}, ObjectiveName{"roughness", "force_change_mean_n"},
    ObjectiveName{"closed_work", "closed_work_share"}};

/// By short name or column. Fails on a name that is none, listing those that are.
Result<Objective> find_objective(std::string_view name);

/// "unconverged = 0", "p99_iterations <= 5", "p99_time <= 20 us", "error <= 1 um": a column may not be above a value.
struct Constraint {
  Objective of;
  double most = 0.0;  ///< in the column's unit
  bool holds(const CellNumbers& numbers, const TimeScale& scale = {}) const { return missed(numbers, scale) <= 0.0; }
  /// By how much it is missed, as a share of the value where that is above 0; 0: it holds.
  double missed(const CellNumbers& numbers, const TimeScale& scale = {}) const;
  std::string text() const;
};
/// A time wants its unit: ns, us or ms; lengths may have one: nm, um, mm or m.
Result<Constraint> parse_constraint(std::string_view text);
/// Fails where two contradict each other in a way that shows: a column below 0.
Status check_constraints(const std::vector<Constraint>& constraints);

}  // namespace tangent::sweep
