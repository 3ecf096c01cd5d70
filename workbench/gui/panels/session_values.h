// The named values of a session's view, as text and back. What can't be read is passed over.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

using ViewValues = std::map<std::string, std::string>;

/// The shortest that reads back as the same double.
std::string text_of_number(double value);
std::string text_of_numbers(const std::vector<double>& values);
/// Increasing numbers as ranges: "0-12,15".
std::string text_of_ranges(const std::vector<std::uint32_t>& numbers);

/// Takes values by their names.
class SavedValues {
 public:
  explicit SavedValues(const ViewValues& values) : values_(values) {}
  const std::string* text(const std::string& name) const;
  std::optional<double> number(const std::string& name) const;
  /// At least that many, finite, with a blank between them; text after them is passed over.
  std::optional<std::vector<double>> numbers(const std::string& name, std::size_t count) const;
  std::optional<std::uint64_t> tick(const std::string& name) const;
  /// Those below `end`; none where it is no list of ranges.
  std::vector<std::uint32_t> ranges(const std::string& name, std::uint32_t end) const;
  void take(const std::string& name, bool& on) const;
  void take(const std::string& name, int& value, int most) const;

 private:
  const ViewValues& values_;
};

}  // namespace tangent
