// workbench-window: what `workbench` hands over to for the window and for pictures, so that everything else loads no
// graphics.
#include "workbench/cli/window/window_commands.h"

#include <array>

int main(int argc, char** argv) {
  constexpr std::array<tangent::AddCommand, 4> kCommands{tangent::add_gui_command, tangent::add_shot_command,
                                                         tangent::add_report_command_with_pictures,
                                                         tangent::add_experiment_command_with_windows};
  return tangent::run_program(argc, argv, kCommands, tangent::run_gui_or_pictures);
}
