// workbench report, with pictures of the worst ticks.
#include "workbench/cli/report_command.h"
#include "workbench/cli/window/window_commands.h"
#include "workbench/gui/platform/tick_picture.h"

namespace tangent {
namespace {

Result<std::string> png_of_tick(const TickToDraw& tick) {
  TickPictureRequest request{tick.scene, tick.preset, tick.tick};
  request.theme = tick.dark ? Theme::dark : Theme::light;
  return tick_picture(request).and_then([](const Image& image) { return png_bytes(image); });
}

}  // namespace

void add_report_command_with_pictures(CLI::App& app, CommandResult& result) {
  add_report_command_with(app, result, png_of_tick);
}

}  // namespace tangent
