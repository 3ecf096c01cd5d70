// workbench gui: the window; and what the program does without a subcommand: the window on the built-in
// scene, or, where there is no display, pictures of it.
#include "workbench/cli/command.h"
#include "workbench/cli/device_options.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"
#include "workbench/cli/window/window_commands.h"
#include "workbench/gui/model/app_model.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/platform/shots.h"
#include "workbench/gui/platform/window.h"
#include "workbench/session/own_folder.h"
#include "workbench/session/servo_options.h"
#include "workbench/session/window_settings.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <memory>
#include <system_error>

namespace tangent {
namespace {

struct GuiOptions {
  MeshOptions mesh;
  AppOptions app;
  DeviceChoice devices;
  bool arm = false;
  bool list_commands = false;
};

int run_gui(const AppOptions& options) {
  const InterruptGuard guard;
  const Status done = run_window(options, [] { return InterruptGuard::requested(); });
  if (done) return kDone;
  print_message("gui", done.error().message());
  return kFailed;
}

/// The page of the window's commands, without a window.
int print_commands() {
  AppOptions options;
  options.deterministic = true;
  AppModel model(options);
  MenuBar menu;
  std::fputs(commands_page(window_commands(model, menu)).c_str(), stdout);
  return kDone;
}

/// Draws the built-in scene to PNG files, for a machine without a display.
int draw_builtin_pictures(const std::string& reason) {
  constexpr std::array<const char*, 4> kPictures{"overview", "iterations", "control-net", "planes"};
  const Result<std::filesystem::path> directory = make_own_folder();
  if (!directory) {
    print_message("", reason + "; and " + directory.error().message());
    return kFailed;
  }
  std::string names;
  for (const char* view : kPictures) {
    ShotRequest request;
    request.view = view;
    const std::filesystem::path file = *directory / (std::string(view) + ".png");
    const Result<Shot> shot = take_shot(request);
    const Status written =
        shot ? write_png(shot->image, file, {.origin = shot->origin}) : Status(tl::unexpected(shot.error()));
    if (!written) {
      print_message("", reason + "; and " + written.error().message());
      return kFailed;
    }
    names += (names.empty() ? "" : ", ") + file.filename().string();
  }
  std::fputs(format("%s; pictures of the built-in scene instead: %s in %s\n", reason.c_str(), names.c_str(),
                    directory->c_str())
                 .c_str(),
             stdout);
  return kDone;
}

}  // namespace

int run_gui_or_pictures() {
  if (const Status display = display_available(); !display) return draw_builtin_pictures(display.error().what);
  AppOptions options;
  options.settings = window_settings_path();
  options.preset_folder = user_presets_path();
  return run_gui(options);
}

void add_gui_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "gui", kGuiCommandText);
  auto options = std::make_shared<GuiOptions>();
  add_mesh_options(*command, options->mesh, false);
  add_text_option(*command, "--preset", options->app.preset, "Preset to start with (default: the shipped one)",
                  "F.toml");
  add_device_options(*command, options->devices);
  add_flag(*command, "--arm", options->arm, kArmText);
  add_number_option(*command, "--servo-hz", {.min = kSlowestServoHz, .max = kFastestServoHz, .unit = "Hz"},
                    "Rate of the servo (default 1000)", [options](double hz) { options->app.servo_hz = hz; });
  add_number_option(*command, "--history-minutes", {.min = 0.1, .max = 120.0, .unit = "min"},
                    "Minutes of ticks to keep, within 1 GiB: 30 at 1 kHz (default 10)",
                    [options](double minutes) { options->app.history_s = 60.0 * minutes; });
  add_text_option(*command, "--record", options->app.record,
                  "Record every tick into this file; one that is there is not written over", "F.sqlite");
  add_text_option(*command, "--script", options->app.script,
                  "Commands to run in the window, one a line (--commands lists them); a line that fails ends it", "F");
  add_flag(*command, "--commands", options->list_commands, "Lists the window's commands, and opens no window");
  on_run(*command, [options, &result] {
    if (options->list_commands) {
      result.exit_code = print_commands();
      return;
    }
    options->app.settings = window_settings_path();
    options->app.preset_folder = user_presets_path();
    options->app.mesh = options->mesh.file.string();
    options->app.metres_per_unit = options->mesh.metres_per_unit;
    options->app.mesh_options = options->mesh.build;
    options->app.devices = options->devices.names;
    options->app.drivers = options->devices.drivers;
    options->app.maestro = options->devices.maestro;
    options->app.packets = options->devices.packets;
    options->app.place = options->devices.place;
    options->app.servo_cpu = options->devices.servo_cpu;
    options->app.arm_on_start = options->arm ? ArmOnStart::always : ArmOnStart::simulated;
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
    result.exit_code = run_gui(options->app);
  });
}

}  // namespace tangent
