// workbench experiment with a person at a device: its options, and trials in a terminal without a window.
#pragma once

#include "workbench/cli/device_options.h"
#include "workbench/experiment/trial_session.h"

namespace CLI {
class App;
}

namespace tangent {

struct TrialChoice {
  DeviceChoice devices;
  bool record = false, without_timeout = false, without_waiting = false;
};

/// Those of the devices, --record, --without-timeout and --without-waiting. `choice` must outlive the parsing.
void add_trial_options(CLI::App& command, TrialChoice& choice);

/// Protocol, participant and folder are the caller's. Fails on a Maestro's setup that can't be used.
Result<experiment::TrialOptions> trial_options(const TrialChoice& choice);

/// With keys from the terminal, or from lines on a pipe (trial_keys.h), to the end of the session or of the keys.
/// Returns the exit code.
Result<int> run_trials(experiment::TrialOptions options);

}  // namespace tangent
