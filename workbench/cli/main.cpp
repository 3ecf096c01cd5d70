#include "workbench/cli/command.h"
#include "workbench/cli/hand_over.h"

int main(int argc, char** argv) {
  if (const std::optional<int> code = tangent::hand_over_to_window(argc, argv)) return *code;
  return tangent::run_program(argc, argv, tangent::headless_commands(), tangent::run_without_command);
}
