// The subcommands of `workbench-window`, the program with the window and the pictures.
#pragma once

#include "workbench/cli/command.h"

namespace tangent {

void add_gui_command(CLI::App& app, CommandResult& result);
void add_shot_command(CLI::App& app, CommandResult& result);
void add_experiment_command_with_windows(CLI::App& app, CommandResult& result);
void add_report_command_with_pictures(CLI::App& app, CommandResult& result);

/// Without a subcommand: the window on the built-in scene; without a display, pictures of it.
int run_gui_or_pictures();

}  // namespace tangent
