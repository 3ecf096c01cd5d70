// workbench experiment, with windows where whoever adds it can open them.
#pragma once

#include "workbench/cli/command.h"
#include "workbench/cli/trial_command.h"

namespace tangent {

/// `in_windows`: empty for one without --window.
void add_experiment_command_with(CLI::App& app, CommandResult& result, const RunTrials& in_windows);

}  // namespace tangent
