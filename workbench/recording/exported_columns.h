// Which columns of a tick are exported, and how their values are written.
#pragma once

#include "core/base/result.h"
#include "workbench/recording/tick_columns.h"

#include <string>
#include <vector>

namespace tangent {

/// A column by its name; neither real nor whole: the number of the tick.
struct ExportedColumn {
  std::string name;
  std::string meaning;
  const RealColumn* real = nullptr;
  const WholeColumn* whole = nullptr;
  bool is_word() const { return whole != nullptr && whole->word != nullptr; }
};

/// What is exported where nothing is chosen.
enum class UsualColumns : std::uint8_t {
  of_ticks_csv,
  all,
};

/// Those of `names`, after the tick's number and time; without names the usual ones. Fails on a name that is none, and
/// lists those that there are.
Result<std::vector<ExportedColumn>> chosen_columns(const std::vector<std::string>& names, UsualColumns usual);

/// The value of a REAL column that there is none of: the device measures no velocity.
bool is_absent(const ExportedColumn& column, const RecordedTick& tick);

/// As ticks.csv writes it; a number that is none is empty.
void append_value(std::string& text, const ExportedColumn& column, RecordedTick& tick);

}  // namespace tangent
