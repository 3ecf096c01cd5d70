#include "workbench/gui/panels/trial_axis.h"

#include "workbench/gui/plots/tick_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {

namespace {

constexpr double kSpanOfLog = 50.0;  ///< from this ratio on an axis of numbers is logarithmic

void include_trials(const TuneModel& tune, TrialAxis& axis, bool kept_only) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double low = kFar, high = -kFar, least = kFar;
  for (const sweep::Trial& trial : tune.trials()) {
    if (kept_only && trial.missed > 0.0) continue;
    const double value = axis.shown(trial);
    low = std::min(low, value);
    high = std::max(high, value);
    if (value > 0.0) least = std::min(least, value);
  }
  if (!(low <= high)) low = 0.0, high = 1.0;
  axis.plain.log = high > kSpanOfLog * least;
  if (axis.plain.log) {
    axis.plain.low = std::pow(10.0, std::floor(std::log10(least)));
    axis.plain.high = std::pow(10.0, std::ceil(std::log10(high)));
  } else {
    const double room = 0.04 * (high > low ? high - low : high != 0.0 ? std::abs(high) : 1.0);
    axis.plain.low = low >= 0.0 ? std::max(0.0, low - room) : low - room;
    axis.plain.high = high + room;
    widen_to_nice(axis.plain.low, axis.plain.high, 8);
  }
}

}  // namespace

TrialAxis objective_axis(const TuneModel& tune, std::size_t index) {
  const sweep::NumberColumn& column = *tune.asked().objectives[index].column;
  TrialAxis axis{{false, index}, column_unit(column).in_si, {}};
  axis.plain.label = column_with_unit(column);
  const auto kept = std::count_if(tune.trials().begin(), tune.trials().end(),
                                  [](const sweep::Trial& trial) { return trial.missed <= 0.0; });
  include_trials(tune, axis, kept >= 2);
  return axis;
}

TrialAxis key_axis(const TuneModel& tune, std::size_t index) {
  const sweep::Range& range = tune.asked().ranges[index];
  const DisplayUnit unit = display_unit(*range.key);
  TrialAxis axis{{true, index}, unit.scale, {range.from / unit.scale, range.to / unit.scale, range.logarithmic, {}}};
  axis.plain.label = std::string(range.key->label) + (unit.name.empty() ? "" : ", " + std::string(unit.name));
  return axis;
}

}  // namespace tangent
