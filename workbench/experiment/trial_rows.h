// Trials as rows of a table, both ways, and what each column means (for the sidecar).
#pragma once

#include "workbench/experiment/comparison_run.h"
#include "workbench/experiment/naming_run.h"
#include "workbench/experiment/row_file.h"

#include <span>
#include <string_view>
#include <vector>

namespace tangent::experiment {

/// The same in every row of a file.
struct RunMark {
  std::string participant;
  std::string simulated = "no";  ///< "no", or the kind of simulated participant
  bool pilot = false;
  bool operator==(const RunMark&) const = default;
};

/// How a row came about. "n/a", as BIDS has it, where there is nothing to say.
struct RowOrigin {
  int interruptions = 0;          ///< how often the trial was begun again: after a fault, a stop, or a killed program
  std::string device = "n/a";     ///< force device and display
  std::string sound = "n/a";      ///< "none", or what played noise and cues
  std::string mesh = "n/a";       ///< hash of the object or of the comparison's polygon
  std::string preset = "n/a";     ///< digest of the preset in use
  std::string protocol = "n/a";   ///< digest
  std::string program = "n/a";    ///< digest of the library that computes ticks
  std::string recording = "n/a";  ///< file of the trial's ticks, beside the table
  bool operator==(const RowOrigin&) const = default;
};

struct ColumnMeaning {
  std::string_view name, unit, meaning;  ///< unit: empty where there is none
};
/// In the order of the table: those of RunMark, of the row, of RowOrigin. Names are a contract; new ones go last.
std::span<const ColumnMeaning> comparison_columns();
std::span<const ColumnMeaning> naming_columns();

Fields fields_of(const RunMark& mark, const ComparisonRow& row, const RowOrigin& origin = {});
Fields fields_of(const RunMark& mark, const NamingRow& row, const RowOrigin& origin = {});

/// By name, in any order, other columns passed over. Fail naming the column and the value.
Result<std::pair<RunMark, ComparisonRow>> comparison_row(const Fields& columns, const Fields& fields);
Result<std::pair<RunMark, NamingRow>> naming_row(const Fields& columns, const Fields& fields);

/// All rows of a participant's table, in its order. Fail as the above.
Result<std::vector<ComparisonRow>> comparison_rows(const RowFile& file);
Result<std::vector<NamingRow>> naming_rows(const RowFile& file);

/// Columns that are not there, as in tables of earlier programs, stay as they are by default.
Result<RowOrigin> row_origin(const Fields& columns, const Fields& fields);

}  // namespace tangent::experiment
