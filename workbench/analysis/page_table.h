// One table for the page and for a CSV file: what people read, and the exact numbers.
#pragma once

#include "workbench/report/html.h"

#include <string>
#include <vector>

namespace tangent::analysis {

class PageTable {
 public:
  /// `name`: of the file, and of its numbers in the page. The first column of the file says whether participants were
  /// simulated.
  PageTable(std::string name, std::string caption, bool simulated);

  /// A column with its name on the page and in the file; the file's has the unit.
  PageTable& column(const std::string& shown, const std::string& in_file);

  class Row {
   public:
    Row& text(const std::string& value);
    /// `shown`: as people read it; one that is not finite is an empty field.
    Row& number(double value, const std::string& shown);
    Row& count(std::uint64_t value);

   private:
    friend class PageTable;
    explicit Row(PageTable& table) : table_(table) {}
    void add(Cell cell, const std::string& field);
    PageTable& table_;
  };
  Row row();

  const std::string& name() const { return name_; }
  std::string html(const std::string& command = {}) const;
  std::string csv() const { return csv_head_ + csv_rows_; }

 private:
  std::string name_;
  bool simulated_;
  Table table_;
  std::vector<std::string> in_file_;
  std::string csv_head_ = "simulated", csv_rows_;
};

/// "12.3 (10.1 to 14.5)", with so many decimals; "12.3" where the interval is not finite.
std::string interval_text(double value, double low, double high, int decimals);
std::string decimals_text(double value, int decimals);
/// "< 0.0001", "0.012"
std::string probability_text(double p);

}  // namespace tangent::analysis
