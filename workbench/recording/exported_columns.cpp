#include "workbench/recording/exported_columns.h"

#include "core/base/text.h"
#include "core/io/ticks_file.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// The second and third of three coordinates mean what the first does.
std::string meaning_after(std::string_view own, const std::vector<ExportedColumn>& before) {
  return own.empty() ? before.back().meaning : std::string(own);
}

std::vector<ExportedColumn> all_columns() {
  std::vector<ExportedColumn> found{{"tick", "number of the tick", nullptr, nullptr}};
  for (const RealColumn& column : real_columns())
    found.push_back({std::string(column.name), meaning_after(column.meaning, found), &column, nullptr});
  for (const auto columns : {whole_columns(), device_columns()})
    for (const WholeColumn& column : columns)
      found.push_back({std::string(column.name), meaning_after(column.meaning, found), nullptr, &column});
  return found;
}

std::vector<std::string> names_of_ticks_csv() {
  std::vector<std::string> names;
  std::string_view left = kTicksHeader;
  for (std::size_t end = 0; end != std::string_view::npos; left.remove_prefix(std::min(end + 1, left.size()))) {
    end = left.find(',');
    names.emplace_back(left.substr(0, end));
    if (end == std::string_view::npos) break;
  }
  return names;
}

}  // namespace

Result<std::vector<ExportedColumn>> chosen_columns(const std::vector<std::string>& names, UsualColumns usual) {
  const std::vector<ExportedColumn> all = all_columns();
  if (names.empty() && usual == UsualColumns::all) return all;
  std::vector<std::string> wanted = names.empty() ? names_of_ticks_csv() : std::vector<std::string>{"tick", "t_s"};
  for (const std::string& name : names)
    if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) wanted.push_back(name);
  std::vector<ExportedColumn> columns;
  for (const std::string& name : wanted) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&name](const auto& column) { return column.name == name; });
    if (found != all.end()) {
      columns.push_back(*found);
      continue;
    }
    std::string known;
    for (const ExportedColumn& column : all) known += (known.empty() ? "" : ", ") + column.name;
    return fail("there is no channel '" + name + "'", "--channels", "choose from: " + known);
  }
  return columns;
}

bool is_absent(const ExportedColumn& column, const RecordedTick& tick) {
  return column.real != nullptr && column.real->of_velocity && !tick.has_velocity;
}

void append_value(std::string& text, const ExportedColumn& column, RecordedTick& tick) {
  if (column.real != nullptr) {
    const double value = column.real->at(tick);
    if (std::isfinite(value) && !is_absent(column, tick)) append_double(text, value);
  } else if (column.is_word()) {
    text += column.whole->word(column.whole->get(tick));
  } else {
    text += column.whole != nullptr ? std::to_string(column.whole->get(tick)) : std::to_string(tick.record.tick.tick);
  }
}

}  // namespace tangent
