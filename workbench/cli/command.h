// The program's subcommands. Each is a function that registers itself with the argument parser and, when it is the one
// asked for, sets the exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace tangent {

/// Exit codes of the program.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,  ///< the work failed; standard error says what, where and what to do
  kUsage = 2,   ///< invalid arguments
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
#ifdef TANGENT_HAS_GUI
void add_gui_command(CLI::App& app, CommandResult& result);
void add_shot_command(CLI::App& app, CommandResult& result);

/// The window on the built-in scene; without a display, PNG files of it. Returns the exit code.
int run_gui_or_pictures();
#endif

/// Runs the program without a subcommand. Returns the exit code.
int run_without_command();

/// Parses the arguments and runs what they ask for. Returns the exit code.
int run_program(int argc, const char* const* argv);

}  // namespace tangent
