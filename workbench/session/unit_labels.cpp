#include "workbench/session/unit_labels.h"

#include "core/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

// Labels of one SI unit are contiguous, the largest first.
constexpr std::array kLabels{UnitLabel{"m", "km", "km", 1e3},
                             UnitLabel{"m", "m", "m", 1.0},
                             UnitLabel{"m", "mm", "mm", kMillimetre, kAny},
                             UnitLabel{"m", "\u00b5m", "um", kMicrometre, 1e-3},
                             UnitLabel{"m", "nm", "nm", 1e-9},
                             UnitLabel{"s", "s", "s", 1.0},
                             UnitLabel{"s", "ms", "ms", 1e-3, kAny},
                             UnitLabel{"N/m", "N/mm", "N/mm", 1e3},
                             UnitLabel{"N/m", "N/m", "N/m", 1.0, kAny},
                             UnitLabel{"N", "N", "N", 1.0, kAny},
                             UnitLabel{"rad", "deg", "deg", kDegree, kAny},
                             UnitLabel{"share", "%", "%", 0.01, kAny},
                             UnitLabel{"1", "", "", 1.0, kAny}};

UnitLabel si_itself(std::string_view si) { return {si, si, si, 1.0, kAny}; }

}  // namespace

std::span<const UnitLabel> labels_of(std::string_view si) {
  const auto of_it = [&](const UnitLabel& label) { return label.si == si; };
  const auto first = std::find_if(kLabels.begin(), kLabels.end(), of_it);
  return {first, std::find_if_not(first, kLabels.end(), of_it)};
}

UnitLabel shown_unit(std::string_view si, double typical) {
  UnitLabel best = si_itself(si);
  bool found = false;
  for (const UnitLabel& label : labels_of(si)) {
    // A small tolerance: the ends of sliders are rounded numbers.
    if (!(typical <= 1.0001 * label.shown_to) || (found && label.shown_to >= best.shown_to)) continue;
    best = label;
    found = true;
  }
  return best;
}

const UnitLabel* find_unit(std::string_view si, std::string_view typed) {
  for (const UnitLabel& label : labels_of(si)) {
    if (!typed.empty() && (typed == label.name || typed == label.plain)) return &label;
  }
  return nullptr;
}

UnitLabel unit_of_size(std::string_view si, double in_si) {
  for (const UnitLabel& label : labels_of(si)) {
    if (std::abs(label.in_si - in_si) <= 1e-9 * in_si) return label;
  }
  return si_itself(si);
}

}  // namespace tangent
