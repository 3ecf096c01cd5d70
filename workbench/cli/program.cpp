// The program: its subcommands, and the handling of invalid arguments.
#include "workbench/cli/command.h"
#include "workbench/cli/messages.h"

#include <cstdio>
#include <exception>
#include <new>

namespace tangent {
namespace {

using AddCommand = void (*)(CLI::App&, CommandResult&);
constexpr AddCommand kCommands[]{
#ifdef TANGENT_HAS_GUI
    add_gui_command,     add_shot_command,
#endif
    add_solve_command,   add_audit_command,    add_make_command,    add_bench_command,  add_tune_command,
    add_figures_command, add_decimate_command, add_devices_command, add_monitor_command};

std::string chosen_command(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? std::string() : chosen.front()->get_name();
}

int parse_and_run(CLI::App& app, CommandResult& result, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 reports help and version by exceptions too, with code 0.
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    const std::string command = chosen_command(app);
    const std::string help = "workbench" + (command.empty() ? "" : " " + command) + " --help";
    print_message(command, std::string(error.what()) + " (see " + help + ")");
    return kUsage;
  }
#ifdef TANGENT_HAS_GUI
  if (app.get_subcommands().empty()) return run_gui_or_pictures();
#else
  if (app.get_subcommands().empty()) return run_without_command();
#endif
  return result.exit_code;
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  CLI::App app("Tangent Workbench: haptic shading of contact location and force, seen and tuned", "workbench");
  app.set_version_flag("--version", "workbench " TANGENT_VERSION);
  app.require_subcommand(0, 1);
  app.footer("Exit codes: 0 done, 1 the work failed, 2 wrong usage.");
  CommandResult result;
  for (const AddCommand add : kCommands) add(app, result);
  try {
    int code = parse_and_run(app, result, argc, argv);
    if (std::fflush(stdout) != 0) {
      print_message("", "standard output can't be written");
      if (code == kDone) code = kFailed;
    }
    return code;
  } catch (const std::bad_alloc&) {
    print_message(chosen_command(app), "not enough memory");
  } catch (const std::exception& error) {
    print_message(chosen_command(app), error.what());
  }
  return kFailed;
}

}  // namespace tangent
