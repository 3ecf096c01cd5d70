// Axes of the plots of trials: an objective or a key, with its range.
#pragma once

#include "workbench/gui/model/tune_model.h"
#include "workbench/gui/plots/axes_drawing.h"

namespace tangent {

/// An axis with what it shows, in shown units.
struct TrialAxis {
  TuneAxis of;
  double in_si = 1.0;
  PlainAxis plain;
  double shown(const sweep::Trial& trial) const { return of.of(trial) / in_si; }
};

/// Over the trials that keep the constraints, where there are some: the others may be anywhere.
TrialAxis objective_axis(const TuneModel& tune, std::size_t index);
/// Over the range that was asked for.
TrialAxis key_axis(const TuneModel& tune, std::size_t index);

}  // namespace tangent
