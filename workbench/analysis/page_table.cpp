#include "workbench/analysis/page_table.h"

#include "core/base/text.h"
#include "workbench/report/numbers.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace tangent::analysis {
namespace {

/// In quotes where it has a comma or quotes of its own.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

PageTable::PageTable(std::string name, std::string caption, bool simulated)
    : name_(std::move(name)), simulated_(simulated) {
  table_.caption = std::move(caption) + (simulated ? " Simulated participants." : "");
}

PageTable& PageTable::column(const std::string& shown, const std::string& in_file) {
  if (!in_file_.empty()) csv_head_.pop_back();
  table_.header.push_back(shown);
  in_file_.push_back(in_file);
  csv_head_ += "," + in_file + "\n";
  return *this;
}

PageTable::Row PageTable::row() {
  table_.rows.emplace_back();
  csv_rows_ += simulated_ ? "yes\n" : "no\n";
  return Row(*this);
}

void PageTable::Row::add(Cell cell, const std::string& field) {
  table_.table_.rows.back().push_back(std::move(cell));
  table_.csv_rows_.pop_back();
  table_.csv_rows_ += "," + field + "\n";
}

PageTable::Row& PageTable::Row::text(const std::string& value) {
  return add(text_cell(value), csv_field(value)), *this;
}

PageTable::Row& PageTable::Row::number(double value, const std::string& shown) {
  const std::size_t column = table_.table_.rows.back().size();
  const std::string name =
      table_.name_ + "." + std::to_string(table_.table_.rows.size()) + "." + table_.in_file_[column];
  if (!std::isfinite(value)) return add(text_cell(shown), ""), *this;
  std::string field;
  append_double(field, value);
  return add(number_cell(name, value, shown), field), *this;
}

PageTable::Row& PageTable::Row::count(std::uint64_t value) {
  return number(static_cast<double>(value), count_text(value));
}

std::string PageTable::html(const std::string& command) const {
  constexpr std::size_t kNarrow = 9;  // columns that fit beside each other
  Table table = table_;
  table.command = command;
  table.wide = table.header.size() > kNarrow;
  return table_html(table);
}

std::string decimals_text(double value, int decimals) {
  if (!std::isfinite(value)) return "none";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string interval_text(double value, double low, double high, int decimals) {
  if (!std::isfinite(low) || !std::isfinite(high)) return decimals_text(value, decimals);
  return decimals_text(value, decimals) + " (" + decimals_text(low, decimals) + " to " + decimals_text(high, decimals) +
         ")";
}

std::string probability_text(double p) { return p < 1e-4 ? "< 0.0001" : digits_text(p); }

}  // namespace tangent::analysis
