#include "core/io/csv_table.h"

#include "core/base/text.h"

#include <algorithm>
#include <optional>

namespace tangent {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ",").append(name);
  return text;
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    fields.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  fields.push_back(line);
  return fields;
}

}  // namespace

std::string show_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c < 127 ? c : '?';
  return out + (text.size() > 40 ? "...\"" : "\"");
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

Result<CsvTable> CsvTable::open(std::string_view text, std::string_view name, std::span<const std::string_view> needed,
                                std::span<const std::string_view> optional) {
  CsvTable table;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  table.text_ = text;
  table.name_ = name;
  table.line_ = take_line(table.text_);
  table.columns_ = split(table.line_);
  table.places_.assign(table.columns_.size(), kPassedOver);
  const auto refuse = [&](std::string_view column, const char* how) {
    return fail("the header is " + show_text(table.line_) + ": " + std::string(column) + " is " + how, table.where(),
                "write the columns " + joined(needed) +
                    (optional.empty() ? "" : ", and all or none of " + joined(optional)) + ", in any order");
  };
  std::size_t place = 0;
  const auto find = [&](std::string_view column) {
    const auto first = std::find(table.columns_.begin(), table.columns_.end(), column);
    if (first != table.columns_.end()) table.places_[static_cast<std::size_t>(first - table.columns_.begin())] = place;
    ++place;
    return std::count(first, table.columns_.end(), column);
  };
  for (const std::string_view column : needed) {
    if (const auto count = find(column); count != 1) return refuse(column, count == 0 ? "missing" : "there twice");
  }
  std::string_view missing;
  for (const std::string_view column : optional) {
    const auto count = find(column);
    if (count > 1) return refuse(column, "there twice");
    if (count == 0 && missing.empty()) missing = column;
    table.has_optional_ = table.has_optional_ || count == 1;
  }
  if (table.has_optional_ && !missing.empty()) return refuse(missing, "missing");
  return table;
}

bool CsvTable::next_line() {
  if (text_.find_first_not_of("\r\n") == std::string_view::npos) return false;
  line_ = take_line(text_);
  ++number_;
  return true;
}

Status CsvTable::read_numbers(std::span<double> numbers) const {
  const char* next = line_.data();
  const char* const last = next + line_.size();
  const std::size_t count = columns_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const char* const end = std::find(next, last, ',');
    const std::string_view field(next, static_cast<std::size_t>(end - next));
    if (places_[i] != kPassedOver) {
      const std::optional<double> value = parse_finite_double(field);
      if (!value)
        return fail(std::string(columns_[i]) + " is " + show_text(field), where(), "write a finite decimal number");
      numbers[places_[i]] = *value;
    }
    const bool wanted_more = i + 1 < count;
    if ((end != last) != wanted_more) {
      return fail(!wanted_more ? "more columns than the header names"
                  : i == 0     ? "only one column"
                               : "only " + std::to_string(i + 1) + " columns",
                  where(), "write " + std::to_string(count) + " fields separated by commas");
    }
    next = end == last ? end : end + 1;
  }
  return {};
}

std::string CsvTable::where() const { return std::string(name_) + ":" + std::to_string(number_); }

}  // namespace tangent
