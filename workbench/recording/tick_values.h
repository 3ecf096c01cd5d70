// Some columns of a recording's ticks, read without the others: a fifth of the time of whole rows (tick_reader.h).
#pragma once

#include "workbench/recording/database.h"

#include <span>
#include <string_view>
#include <vector>

namespace tangent {

class TickValues {
 public:
  /// Ticks from `first` to `last`, both included, in order. `columns`: names of tick_rows, which must be its own.
  /// Precondition: the file was opened as a Recording before, which checks it.
  static Result<TickValues> open(const std::filesystem::path& path, std::span<const std::string_view> columns,
                                 std::uint64_t first, std::uint64_t last);

  /// False: there is no further one. Fails on a value that is no number.
  Result<bool> next();
  std::uint64_t tick() const { return tick_; }
  double operator[](std::size_t column) const { return values_[column]; }

 private:
  TickValues(Database database, Statement rows, std::span<const std::string_view> columns)
      : database_(std::move(database)),
        rows_(std::move(rows)),
        columns_(columns.begin(), columns.end()),
        values_(columns.size()) {}

  Database database_;
  Statement rows_;  ///< ends before its database
  std::vector<std::string_view> columns_;
  std::vector<double> values_;
  std::uint64_t tick_ = 0;
};

/// "tick BETWEEN first AND last", for SQL.
std::string between_sql(std::string_view column, std::uint64_t first, std::uint64_t last);

}  // namespace tangent
