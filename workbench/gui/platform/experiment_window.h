// An experiment in two windows: the operator's, and the participant's, which fills a second monitor where there is one.
// Keys pressed in the participant's window are answers; Escape stops the force in both.
#pragma once

#include "workbench/experiment/sound/sound_follower.h"
#include "workbench/experiment/trial_session.h"
#include "workbench/gui/theme/palette.h"

#include <functional>
#include <optional>
#include <string>

namespace tangent {

struct ExperimentWindowOptions {
  experiment::TrialOptions trials;                 ///< its `sound` is set here
  std::optional<experiment::SoundSettings> sound;  ///< none: the run is silent, and its rows say so
  std::string sound_device = experiment::kDefaultSoundDevice;
  Theme theme = Theme::dark;
};

struct ExperimentOutcome {
  std::filesystem::path rows;
  int answers = 0;  ///< of all starts
  bool complete = false;
};

/// Until the operator ends it, the participant is through, or `should_stop`. Fails without a display, sound device or
/// force device, before anybody is enrolled; and where an answer or note could not be written.
Result<ExperimentOutcome> run_experiment_window(ExperimentWindowOptions options,
                                                const std::function<bool()>& should_stop);

}  // namespace tangent
