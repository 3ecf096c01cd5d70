// workbench experiment with a person at a device: its options, and trials in a terminal without a window.
#pragma once

#include "workbench/cli/device_options.h"
#include "workbench/experiment/sound/sound_follower.h"
#include "workbench/experiment/trial_session.h"

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace tangent {

struct TrialChoice {
  DeviceChoice devices;
  bool record = false, same_day = false, without_timeout = false, without_waiting = false;
  bool window = false;
  std::optional<bool> sound;  ///< none: with a window
  std::string sound_device = experiment::kDefaultSoundDevice;
};

/// What an experiment needs to begin, in a terminal or in windows.
struct TrialsToRun {
  experiment::TrialOptions trials;                 ///< its `sound` is still to be set
  std::optional<experiment::SoundSettings> sound;  ///< none: silent
  std::string sound_device;
};
/// Returns the exit code.
using RunTrials = std::function<Result<int>(TrialsToRun)>;

/// Those of the devices, --record, --same-day, --without-timeout, --without-waiting, --window, --sound and
/// --sound-device. `choice` must outlive the parsing.
void add_trial_options(CLI::App& command, TrialChoice& choice);

/// Protocol, participant and folder are the caller's. Fails on a Maestro's setup that can't be used.
Result<experiment::TrialOptions> trial_options(const TrialChoice& choice);

/// With keys from the terminal, or from lines on a pipe (trial_keys.h), to the end of the session or of the keys.
/// Returns the exit code.
Result<int> run_trials(TrialsToRun wanted);
/// What is said at the end, and the exit code.
int say_outcome(const std::filesystem::path& rows, int answers, bool complete);

}  // namespace tangent
