// CSV tables read by column name: a header of names, then lines of numbers. Columns may be in any order, and unknown
// ones are ignored, so that files with more columns can be read too.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// At most 40 characters of a damaged file in quotes, printable.
std::string show_text(std::string_view text);

/// Cuts the next line off `text`, without its line end ("\n" or "\r\n").
std::string_view take_line(std::string_view& text);

/// Reads one table line by line. Keeps views of its arguments, which must outlive it.
class CsvTable {
 public:
  /// Reads the header. Fails on one without a column of `needed`, with a column of either kind twice, or with some but
  /// not all of `optional`, naming it.
  static Result<CsvTable> open(std::string_view text, std::string_view name, std::span<const std::string_view> needed,
                               std::span<const std::string_view> optional = {});

  bool has_optional() const { return has_optional_; }
  /// Advances to the next line; false at the end (trailing blank lines are allowed).
  bool next_line();
  /// Reads the line's numbers: those of `needed` in its order, then those of `optional`, which stay unchanged where the
  /// table has none. Fails on a value that is not a finite number, and on a wrong number of fields. Precondition:
  /// `numbers` has room for all of them.
  Status read_numbers(std::span<double> numbers) const;
  std::string where() const;  ///< "poses.csv:12"

 private:
  static constexpr std::size_t kPassedOver = std::numeric_limits<std::size_t>::max();

  std::string_view text_, line_, name_;
  std::size_t number_ = 1;  ///< of the line, the header being 1
  std::vector<std::string_view> columns_;
  std::vector<std::size_t> places_;  ///< of each column in `numbers`
  bool has_optional_ = false;
};

}  // namespace tangent
