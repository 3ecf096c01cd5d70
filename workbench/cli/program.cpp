// The program: its subcommands, and the handling of invalid arguments.
#include "workbench/cli/command.h"
#include "workbench/cli/messages.h"
#include "workbench/session/crash_stop.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

namespace tangent {
namespace {

/// Named for --help; they never run here (hand_over.h).
void add_window_commands(CLI::App& app, CommandResult&) {
  app.add_subcommand("gui", kGuiCommandText);
  app.add_subcommand("shot", kShotCommandText);
}

constexpr AddCommand kCommands[]{add_window_commands, add_solve_command,   add_audit_command,      add_make_command,
                                 add_bench_command,   add_tune_command,    add_figures_command,    add_decimate_command,
                                 add_devices_command, add_monitor_command, add_record_command,     add_replay_command,
                                 add_compare_command, add_explain_command, add_export_command,     add_check_command,
                                 add_sweep_command,   add_report_command,  add_experiment_command, add_analyse_command};

std::string chosen_command(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? std::string() : chosen.front()->get_name();
}

/// CLI11's words, but for those that say it in terms of its own: how many values an option may have in all, and what is
/// left over, in the order in which it takes things.
std::string usage_error_text(const CLI::App& app, const CLI::ParseError& error) {
  const std::string text = error.what();
  if (const std::size_t at = text.find(": At Most 1 required"); at != std::string::npos)
    return text.substr(0, at) + ": is given more than once; give it once";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return text;
  std::string left;
  for (const std::string& word : app.remaining(true)) left += " " + word;
  return left.empty() ? text : "not expected:" + left;
}

int parse_and_run(CLI::App& app, CommandResult& result, int argc, const char* const* argv, int (*without_command)()) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 reports help and version by exceptions too, with code 0.
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    const std::string command = chosen_command(app);
    const std::string help = "workbench" + (command.empty() ? "" : " " + command) + " --help";
    print_message(command, usage_error_text(app, error) + " (see " + help + ")");
    return kUsage;
  }
  return app.get_subcommands().empty() ? without_command() : result.exit_code;
}

}  // namespace

std::span<const AddCommand> headless_commands() { return kCommands; }

int run_program(int argc, const char* const* argv, std::span<const AddCommand> commands, int (*without_command)()) {
  install_crash_stop();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may grow no further is an error of its writer, which says so
  CLI::App app("Tangent Workbench: visual debugger and tuning tool for haptic shading of contact location and force",
               "workbench");
  app.set_version_flag("--version", "workbench " TANGENT_VERSION);
  app.require_subcommand(0, 1);
  app.footer("Exit codes: 0 done, 1 the work failed, 2 wrong usage.");
  CommandResult result;
  for (const AddCommand add : commands) add(app, result);
  try {
    int code = parse_and_run(app, result, argc, argv, without_command);
    if (std::fflush(stdout) != 0) {
      print_message("", "standard output can't be written");
      if (code == kDone) code = kFailed;
    }
    return code;
  } catch (const std::bad_alloc&) {
    print_message(chosen_command(app), "not enough memory");
  } catch (const std::system_error& error) {
    // What starting a thread says where there is no room for its stack.
    const bool room = error.code() == std::errc::resource_unavailable_try_again;
    print_message(chosen_command(app), room ? "not enough memory for another thread" : error.what());
  } catch (const std::exception& error) {
    print_message(chosen_command(app), error.what());
  }
  return kFailed;
}

}  // namespace tangent
