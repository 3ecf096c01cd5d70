#include "workbench/cli/command.h"

int main(int argc, char** argv) { return tangent::run_program(argc, argv); }
