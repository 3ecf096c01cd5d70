#include "workbench/report/numbers.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace tangent {
namespace {

struct Unit {
  double size;
  const char* name;
};

/// In the largest unit that is not above the value.
std::string in_units(double value, std::span<const Unit> units) {
  if (!std::isfinite(value)) return "none";
  if (value == 0.0) return "0";
  for (const Unit& unit : units)
    if (std::abs(value) >= unit.size) return digits_text(value / unit.size) + " " + unit.name;
  return digits_text(value / units.back().size) + " " + units.back().name;
}

}  // namespace

std::string count_text(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string digits_text(double value) {
  if (!std::isfinite(value)) return "none";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string two_digits_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

std::string metres_text(double metres) {
  constexpr std::array kUnits{Unit{1e-3, "mm"}, Unit{1e-6, "\xC2\xB5m"}, Unit{1e-9, "nm"}, Unit{1e-12, "pm"}};
  return in_units(metres, kUnits);
}

std::string time_text(double ns) {
  constexpr std::array kUnits{Unit{1e9, "s"}, Unit{1e6, "ms"}, Unit{1e3, "\xC2\xB5s"}, Unit{1.0, "ns"}};
  return in_units(ns, kUnits);
}

std::string seconds_text(double seconds) {
  if (!(seconds >= 60.0)) return digits_text(seconds) + " s";
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  std::array<char, 48> text{};
  if (whole >= 3600)
    std::snprintf(text.data(), text.size(), "%llu h %02llu min", static_cast<unsigned long long>(whole / 3600),
                  static_cast<unsigned long long>(whole / 60 % 60));
  else
    std::snprintf(text.data(), text.size(), "%llu min %02llu s", static_cast<unsigned long long>(whole / 60),
                  static_cast<unsigned long long>(whole % 60));
  return text.data();
}

std::string share_text(std::uint64_t part, std::uint64_t of) {
  return of == 0 ? "none" : digits_text(100.0 * static_cast<double>(part) / static_cast<double>(of)) + " %";
}

}  // namespace tangent
