// workbench report, with pictures where whoever adds it can draw them.
#pragma once

#include "workbench/cli/command.h"
#include "workbench/report/report_data.h"

namespace tangent {

/// `draw`: empty for a report without pictures.
void add_report_command_with(CLI::App& app, CommandResult& result, DrawTick draw);

}  // namespace tangent
