#include "workbench/gui/render/quantity_text.h"

#include "workbench/session/unit_labels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {

std::string length_text(double metres) {
  const auto units = labels_of("m");
  const double size = std::abs(metres);
  const auto fits =
      std::find_if(units.begin(), units.end() - 1, [&](const UnitLabel& u) { return size >= 0.9995 * u.in_si; });
  const double value = size == 0.0 ? 0.0 : metres / fits->in_si;
  const std::string unit(size == 0.0 ? shown_unit("m", 1.0).name : fits->name);
  char text[48];
  // Beyond the units' range: scientific notation instead of long digits or a "0.00" that is not zero.
  if (std::abs(value) >= 1e5 || (value != 0.0 && std::abs(value) < 9.5e-3)) {
    std::snprintf(text, sizeof text, "%.3g %s", value, unit.c_str());
  } else if (std::abs(value - std::round(value)) <= 1e-9 * std::abs(value)) {
    std::snprintf(text, sizeof text, "%.0f %s", value, unit.c_str());
  } else {
    const double magnitude = std::abs(value);
    std::snprintf(text, sizeof text, "%.*f %s",
                  magnitude >= 99.95   ? 0
                  : magnitude >= 9.995 ? 1
                                       : 2,
                  value, unit.c_str());
  }
  return text;
}

double round_number_below(double limit) {
  const double decade = std::pow(10.0, std::floor(std::log10(limit)));
  const double lead = limit / decade;
  return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * decade;
}

}  // namespace tangent
