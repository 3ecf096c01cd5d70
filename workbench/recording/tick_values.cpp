#include "workbench/recording/tick_values.h"

#include <algorithm>

namespace tangent {

std::string between_sql(std::string_view column, std::uint64_t first, std::uint64_t last) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
  return std::string(column) + " BETWEEN " + std::to_string(std::min(first, kMost)) + " AND " +
         std::to_string(std::min(last, kMost));
}

Result<TickValues> TickValues::open(const std::filesystem::path& path, std::span<const std::string_view> columns,
                                    std::uint64_t first, std::uint64_t last) {
  Result<Database> database = Database::open(path);
  if (!database) return tl::unexpected(database.error());
  std::string sql = "SELECT tick";
  for (const std::string_view column : columns) sql += ", " + std::string(column);
  Result<Statement> rows =
      database->prepare(sql + " FROM tick_rows WHERE " + between_sql("tick", first, last) + " ORDER BY tick");
  if (!rows) return tl::unexpected(rows.error());
  return TickValues(std::move(*database), std::move(*rows), columns);
}

Result<bool> TickValues::next() {
  const Result<bool> row = rows_.step();
  if (!row || !*row) return row;
  tick_ = static_cast<std::uint64_t>(rows_.whole(0));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const int column = static_cast<int>(i) + 1;
    if (!rows_.is_number(column))
      return fail("is not a number", "tick " + std::to_string(tick_) + ", column " + std::string(columns_[i]),
                  "the file is damaged: copy it from where it was recorded again");
    values_[i] = rows_.real(column);
  }
  return true;
}

}  // namespace tangent
