// Rows in, columns out: a table that is longer than memory should hold, in an unnamed file.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace tangent {

class ColumnSpool {
 public:
  /// A file without a name in `folder` (empty: this one), of that many columns of 8 bytes each. Messages name `target`,
  /// which is written from it.
  static Result<ColumnSpool> create(const std::filesystem::path& folder, std::size_t columns,
                                    const std::filesystem::path& target);

  ColumnSpool(ColumnSpool&& other) noexcept;
  ColumnSpool& operator=(ColumnSpool&&) = delete;
  ~ColumnSpool();

  /// One row, a value for each column.
  Status add(const std::vector<std::uint64_t>& row);
  std::uint64_t rows() const { return rows_; }
  /// After the last row. A column's values in order, in memory: 8 bytes a row.
  Status read(std::size_t column, std::vector<std::uint64_t>& values);

 private:
  static constexpr std::size_t kBlockRows = 4096;
  ColumnSpool(int file, std::filesystem::path target, std::size_t columns)
      : file_(file), for_(std::move(target)), columns_(columns), block_(columns * kBlockRows) {}
  Status flush();
  tl::unexpected<Error> system_failure(const char* doing) const;

  int file_;
  std::filesystem::path for_;
  std::size_t columns_;
  std::uint64_t rows_ = 0;
  std::vector<std::uint64_t> block_;  ///< of each column kBlockRows values, one column after the other
};

}  // namespace tangent
