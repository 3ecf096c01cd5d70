// The program's subcommands. Each is a function that registers itself with the argument parser and, when it is the one
// asked for, sets the exit code.
#pragma once

namespace CLI {
class App;
}

#include <span>

namespace tangent {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,    ///< the work failed; standard error says what, where and what to do
  kUsage = 2,     ///< invalid arguments
  kCantTell = 3,  ///< of check alone: a preset can't be checked
};

struct CommandResult {
  int exit_code = kDone;
};

void add_solve_command(CLI::App& app, CommandResult& result);
void add_audit_command(CLI::App& app, CommandResult& result);
void add_make_command(CLI::App& app, CommandResult& result);
void add_bench_command(CLI::App& app, CommandResult& result);
void add_tune_command(CLI::App& app, CommandResult& result);
void add_figures_command(CLI::App& app, CommandResult& result);
void add_decimate_command(CLI::App& app, CommandResult& result);
void add_devices_command(CLI::App& app, CommandResult& result);
void add_monitor_command(CLI::App& app, CommandResult& result);
void add_record_command(CLI::App& app, CommandResult& result);
void add_replay_command(CLI::App& app, CommandResult& result);
void add_compare_command(CLI::App& app, CommandResult& result);
void add_explain_command(CLI::App& app, CommandResult& result);
void add_export_command(CLI::App& app, CommandResult& result);
void add_check_command(CLI::App& app, CommandResult& result);
void add_sweep_command(CLI::App& app, CommandResult& result);
void add_report_command(CLI::App& app, CommandResult& result);  ///< without pictures: report_command.h
void add_experiment_command(CLI::App& app, CommandResult& result);
void add_analyse_command(CLI::App& app, CommandResult& result);

/// What the subcommands of workbench-window do (window/), which `workbench` lists, too.
inline constexpr const char* kGuiCommandText = "Open the window";
inline constexpr const char* kShotCommandText =
    "Write a view of the window or of the 3D scene as PNG; needs no display";

inline constexpr const char* kReportCommandText = "Recordings as one page of HTML, for a paper or a colleague";

using AddCommand = void (*)(CLI::App&, CommandResult&);

/// Those of the program without a window.
std::span<const AddCommand> headless_commands();

/// What the program does without a subcommand and without the window: solves the built-in scene.
int run_without_command();

/// Parses the arguments and runs what they ask for. Returns the exit code.
int run_program(int argc, const char* const* argv, std::span<const AddCommand> commands, int (*without_command)());

}  // namespace tangent
