// workbench shot: any view as a PNG, with no display.
#include "core/io/replaceable_file.h"
#include "workbench/cli/command.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"
#include "workbench/cli/window/window_commands.h"
#include "workbench/gui/platform/shots.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <memory>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 2> kThemes{"dark", "light"};  // order of Theme
constexpr std::array<std::string_view, 2> kUpAxes{"z", "y"};

struct ShotOptions {
  MeshOptions mesh;
  ShotRequest request;
  std::filesystem::path file;
};

void list_views() {
  for (const ShotView& view : shot_views()) {
    std::fputs(format("%-16s %s\n", view.name.c_str(), view.shows.c_str()).c_str(), stdout);
  }
}

Status write_shot(const ShotRequest& request, const std::filesystem::path& file) {
  const auto is_png = [](std::string_view beginning) { return beginning.starts_with("\x89PNG"); };
  if (Status ok = check_replaceable(file, "a PNG", is_png); !ok) return ok;
  const Result<Shot> shot = take_shot(request);
  if (!shot) return tl::unexpected(shot.error());
  if (file.empty()) return {};  // the script's own pictures are all
  const PngOptions options{request.transparent, shot->origin};
  if (Status written = write_png(shot->image, file, options); !written) return written;
  const std::string size = format("%d x %d", shot->image.width, shot->image.height);
  const char* const what = request.view.empty() ? "window" : request.view.c_str();
  std::fputs(format("%s: %s, %s\n", file.c_str(), what, size.c_str()).c_str(), stdout);
  return {};
}

/// Whether the name says a PNG; a device or a pipe needs none.
bool is_png_name(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) return true;
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".png";
}

Status make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder)) return {};
  return fail("this folder can't be made", folder.string(), "name another with --out");
}

/// Wrong usage, in words; empty: none.
std::string usage_error(const ShotRequest& request, const std::filesystem::path& file) {
  const auto& views = shot_views();
  const bool all = request.view == "all";
  const auto is_named = [&](const ShotView& v) { return v.name == request.view; };
  const bool known = std::any_of(views.begin(), views.end(), is_named);
  if (request.view.empty() && request.script.empty())
    return "say with --view what to draw, or with --script what to do (see workbench shot --help)";
  if (!request.script.empty() && (all || (known && !is_window_view(request.view))))
    return "--script needs a view of the window, not \"" + request.view + "\"; leave --view out";
  if (!all && !request.view.empty() && !known)
    return "there is no view \"" + request.view + "\"; choose one of: " + shot_view_names() + " (or list, all)";
  if (request.transparent && (all || !is_scene_view(request.view)))
    return "the window has no transparent ground; choose a view of the scene (--view list)";
  if (file.empty() && request.script.empty())
    return "say with --out where the picture goes (see workbench shot --help)";
  if (!all && !file.empty() && !is_png_name(file))
    return "--out: " + file.string() + " names no format that is written; end it in .png";
  const Status mesh = check_shot_mesh(request);
  return mesh ? std::string() : mesh.error().message();
}

/// Every view that there is; one that does not take the mesh with its own.
Status write_all(const ShotRequest& request, const std::filesystem::path& folder) {
  if (Status made = make_folder(folder); !made) return made;
  std::uint64_t drawn = 0;
  for (const ShotView& view : shot_views()) {
    ShotRequest one = request;
    one.view = view.name;
    if (!check_shot_mesh(one)) one.mesh.clear();
    const Status done = write_shot(one, folder / (view.name + ".png"));
    drawn += done ? 1 : 0;
    if (InterruptGuard::requested())
      return fail("interrupted; " + folder.string() + " holds " + count_text(drawn, "picture", "pictures") + " of " +
                  std::to_string(shot_views().size()));
    if (!done) return done;
  }
  return {};
}

int run_shot(const ShotOptions& options) {
  if (options.request.view == "list") {
    list_views();
    return kDone;
  }
  ShotRequest request = options.request;
  request.mesh = options.mesh.file.string();
  request.metres_per_unit = options.mesh.metres_per_unit;
  request.mesh_options = options.mesh.build;
  if (const std::string wrong = usage_error(request, options.file); !wrong.empty()) {
    print_message("shot", wrong);
    return kUsage;
  }
  const InterruptGuard guard;
  request.stop = [] { return InterruptGuard::requested(); };
  const Status done = request.view == "all" ? write_all(request, options.file) : write_shot(request, options.file);
  if (!done) print_message("shot", done.error().message());
  return done ? kDone : kFailed;
}

}  // namespace

void add_shot_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "shot", kShotCommandText);
  auto options = std::make_shared<ShotOptions>();
  ShotRequest* request = &options->request;
  add_mesh_options(*command, options->mesh, false);
  add_text_option(*command, "--view", request->view, "Name of the view; list: names them all; all: every one", "NAME");
  add_text_option(*command, "--script", request->script,
                  "Commands to run in the window first, one a line (gui --commands lists them)", "F");
  add_text_option(*command, "--out", options->file, "File to write; with --view all: a folder, made if it isn't there",
                  "F.png");
  add_text_option(*command, "--preset", request->preset,
                  "Preset of the window's views (default: the program's own values)", "F.toml");
  add_number_option(*command, "--width", {.min = 64, .max = 8192, .unit = "pixels", .whole = true},
                    "Width (default 1280)", [request](double n) { request->width_px = static_cast<int>(n); });
  add_number_option(*command, "--height", {.min = 64, .max = 8192, .unit = "pixels", .whole = true},
                    "Height (default 720)", [request](double n) { request->height_px = static_cast<int>(n); });
  add_number_option(*command, "--scale", {.min = 0.5, .max = 4.0},
                    "Size of text and lines; 2 for a HiDPI picture (default 1; views of the scene: height / 720)",
                    [request](double scale) { request->scale = scale; });
  add_choice_option(*command, "--theme", kThemes, "Colours (default: the view's own)",
                    [request](int theme) { request->theme = static_cast<Theme>(theme); });
  add_choice_option(*command, "--up", kUpAxes, "Axis of the mesh that is up in the picture (default z)",
                    [request](int axis) { request->y_up = axis == 1; });
  add_flag(*command, "--transparent", request->transparent, "Nothing behind the scene; for views of the scene");
  on_run(*command, [options, &result] { result.exit_code = run_shot(*options); });
}

}  // namespace tangent
