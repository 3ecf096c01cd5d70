// workbench experiment --window.
#include "workbench/cli/experiment_command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/window/window_commands.h"
#include "workbench/gui/platform/experiment_window.h"
#include "workbench/session/window_settings.h"

#include <csignal>

namespace tangent {
namespace {

Result<int> run_in_windows(TrialsToRun wanted) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
  const InterruptGuard guard;
  ExperimentWindowOptions options{std::move(wanted.trials), wanted.sound, wanted.sound_device, Theme::dark};
  const auto outcome = run_experiment_window(std::move(options), [] { return InterruptGuard::requested(); });
  if (!outcome) return tl::unexpected(outcome.error());
  return say_outcome(outcome->rows, outcome->answers, outcome->complete);
}

}  // namespace

void add_experiment_command_with_windows(CLI::App& app, CommandResult& result) {
  add_experiment_command_with(app, result, run_in_windows);
}

}  // namespace tangent
