#include "workbench/gui/panels/session_values.h"

#include "core/base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace tangent {

std::string text_of_number(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

std::string text_of_numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    append_double(text, value);
  }
  return text;
}

std::string text_of_ranges(const std::vector<std::uint32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t from = i;
    while (i + 1 < numbers.size() && numbers[i + 1] == numbers[i] + 1) ++i;
    text += (text.empty() ? "" : ",") + std::to_string(numbers[from]);
    if (i > from) text += "-" + std::to_string(numbers[i]);
  }
  return text;
}

const std::string* SavedValues::text(const std::string& name) const {
  const auto found = values_.find(name);
  return found != values_.end() ? &found->second : nullptr;
}

std::optional<double> SavedValues::number(const std::string& name) const {
  const std::string* given = text(name);
  return given != nullptr ? parse_finite_double(*given) : std::nullopt;
}

std::optional<std::vector<double>> SavedValues::numbers(const std::string& name, std::size_t count) const {
  const std::string* given = text(name);
  if (given == nullptr) return std::nullopt;
  std::vector<double> out;
  for (std::size_t at = 0; out.size() < count && at < given->size();) {
    const std::size_t end = std::min(given->find(' ', at), given->size());
    const auto value = parse_finite_double(std::string_view(*given).substr(at, end - at));
    if (!value) return std::nullopt;
    out.push_back(*value);
    at = end + 1;
  }
  return out.size() == count ? std::optional(out) : std::nullopt;
}

std::optional<std::uint64_t> SavedValues::tick(const std::string& name) const {
  const std::optional<double> value = number(name);
  return value && *value >= 0.0 && *value < 1e15 ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
}

std::vector<std::uint32_t> SavedValues::ranges(const std::string& name, std::uint32_t end) const {
  const std::string* given = text(name);
  std::vector<std::uint32_t> out;
  if (given == nullptr) return out;
  const char *at = given->data(), *last = at + given->size();
  while (at != last) {
    std::uint32_t from = 0;
    auto read = std::from_chars(at, last, from);
    if (read.ec != std::errc()) return {};
    std::uint32_t to = from;
    if (read.ptr != last && *read.ptr == '-') read = std::from_chars(read.ptr + 1, last, to);
    if (read.ec != std::errc() || to < from || (!out.empty() && from <= out.back())) return {};
    for (std::uint32_t n = from; n < end && n <= to; ++n) out.push_back(n);
    at = read.ptr;
    if (at != last && *at++ != ',') return {};
  }
  return out;
}

void SavedValues::take(const std::string& name, bool& on) const {
  if (const std::string* given = text(name)) on = *given == "on";
}

void SavedValues::take(const std::string& name, int& value, int most) const {
  if (const auto given = number(name)) value = static_cast<int>(std::clamp(*given, 0.0, static_cast<double>(most)));
}

}  // namespace tangent
