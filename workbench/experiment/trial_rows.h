// Trials as rows of a table, both ways, and what each column means (for the sidecar).
#pragma once

#include "workbench/experiment/comparison_run.h"
#include "workbench/experiment/naming_run.h"
#include "workbench/experiment/row_file.h"

#include <span>
#include <string_view>

namespace tangent::experiment {

/// The same in every row of a file.
struct RunMark {
  std::string participant;
  std::string simulated = "no";  ///< "no", or the kind of simulated participant
  bool pilot = false;
  bool operator==(const RunMark&) const = default;
};

struct ColumnMeaning {
  std::string_view name, unit, meaning;  ///< unit: empty where there is none
};
/// In the order of the table, those of RunMark first. Names are a contract; new ones go last.
std::span<const ColumnMeaning> comparison_columns();
std::span<const ColumnMeaning> naming_columns();

Fields fields_of(const RunMark& mark, const ComparisonRow& row);
Fields fields_of(const RunMark& mark, const NamingRow& row);

/// By name, in any order, other columns passed over. Fail naming the column and the value.
Result<std::pair<RunMark, ComparisonRow>> comparison_row(const Fields& columns, const Fields& fields);
Result<std::pair<RunMark, NamingRow>> naming_row(const Fields& columns, const Fields& fields);

}  // namespace tangent::experiment
