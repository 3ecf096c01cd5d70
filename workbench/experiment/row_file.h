// Answers on disk: a table in tabs after BIDS (`_beh.tsv`, bids-specification.readthedocs.io), one row a trial, only
// ever appended to. A row is on the disk before the next stimulus is shown; a process that is killed leaves at most one
// torn row, which the next one cuts off. Beside it is the same as CSV, without `check`. The last column, `check`, is a
// checksum of the row and of the one before it: a table that was edited, cut or joined by hand is told.
#pragma once

#include "core/io/appended_file.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tangent::experiment {

using Fields = std::vector<std::string>;

class RowFile {
 public:
  /// Makes the file, or goes on with it. `columns` without `check`; `identity`: what the rows belong to, part of the
  /// first row's checksum. Fails on a file with other columns, of another identity, edited, or in use by another
  /// process, naming it and the line.
  static Result<RowFile> open(const std::filesystem::path& path, const Fields& columns, const std::string& identity);
  RowFile(RowFile&& other) noexcept;
  RowFile& operator=(RowFile&&) = delete;
  ~RowFile();

  const std::vector<Fields>& rows() const { return rows_; }    ///< that were there, without `check`
  std::size_t count() const { return rows_.size() + added_; }  ///< rows in the file
  /// On the disk when it returns; where it fails (a full disk), nothing of it is, and it can be tried again.
  /// Precondition: as many fields as columns, none with a tab or a line end.
  Status add(const Fields& fields);

 private:
  explicit RowFile(AppendedFile file) : file_(std::move(file)) {}
  Status begin_csv(const Fields& columns);
  AppendedFile file_;
  int csv_ = -1;  ///< a copy for people: what it lacks after an end out of order, the next start writes
  std::string last_check_;
  std::vector<Fields> rows_;
  std::size_t added_ = 0;
};

/// A table that was read.
struct ReadRows {
  Fields columns;            ///< without `check`
  std::vector<Fields> rows;  ///< whole ones
  std::string complaint;     ///< why its checksums do not hold; empty: they do
};
/// A torn last row is left out. Fails on what is no such table, naming file and line.
Result<ReadRows> read_rows(const std::filesystem::path& path, const std::string& identity);

}  // namespace tangent::experiment
