#include "workbench/gui/platform/shots.h"

#include "core/base/text.h"
#include "core/io/polygon_io.h"
#include "workbench/gui/platform/experiment_shots.h"
#include "workbench/gui/platform/scene_shots.h"
#include "workbench/gui/platform/window_shots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

const std::vector<ShotView>& shot_views() {
  static const std::vector<ShotView> kViews = [] {
    std::vector<ShotView> views = window_shot_views();
    for (const std::vector<ShotView>& more : {experiment_shot_views(), scene_shot_views()})
      views.insert(views.end(), more.begin(), more.end());
    return views;
  }();
  return kViews;
}

std::string shot_view_names() {
  std::string names;
  for (const ShotView& view : shot_views()) names += (names.empty() ? "" : " ") + view.name;
  return names;
}

namespace {

bool has(const std::vector<ShotView>& views, std::string_view name) {
  return std::any_of(views.begin(), views.end(), [&](const ShotView& v) { return v.name == name; });
}

}  // namespace

bool is_scene_view(std::string_view view) { return has(scene_shot_views(), view); }
bool is_window_view(std::string_view view) { return has(window_shot_views(), view); }

Status check_shot_mesh(const ShotRequest& request) {
  const std::vector<ShotView>& views = shot_views();
  const auto view = std::find_if(views.begin(), views.end(), [&](const ShotView& v) { return v.name == request.view; });
  if (request.mesh.empty() || view == views.end() || view->takes == ShotTakes::mesh_or_polygon) return {};
  const std::string draws = "the view " + view->name + " draws ";
  if (view->takes == ShotTakes::nothing)
    return fail(draws + view->shows + ", and no mesh", request.mesh,
                is_scene_view(view->name) ? "leave the mesh out, or draw it with the view both-surfaces"
                                          : "leave the mesh out");
  const bool polygon = is_planar_file(request.mesh);
  if (view->takes == ShotTakes::polygon && !polygon)
    return fail(draws + "a polygon, and this is none", request.mesh,
                "give a .csv of x_m,y_m or an .obj with a line element, or leave it out");
  if (view->takes == ShotTakes::mesh && polygon)
    return fail(draws + "a mesh, and this is a polygon", request.mesh,
                "give a .obj with faces, .ply, .stl or .off, or draw the polygon with the view planar");
  return {};
}

std::string shot_command(const ShotRequest& request, double scale, Theme theme) {
  std::string text = "workbench shot";
  const auto add = [&](const char* option, const std::string& value) {
    text += std::string(" ") + option + " " + shell_word(value);
  };
  const auto add_number = [&](const char* option, double value) {
    std::string digits;
    append_double(digits, value);
    add(option, digits);
  };
  if (!request.mesh.empty()) text += " " + shell_word(request.mesh);
  if (!request.view.empty()) add("--view", request.view);
  if (!request.script.empty()) add("--script", request.script.string());
  if (!request.preset.empty()) add("--preset", request.preset.string());
  constexpr double kPi = std::numbers::pi;
  if (const double mm = request.metres_per_unit / 1e-3; mm != 1.0)
    add("--unit", mm == 10.0 ? "cm" : mm == 1000.0 ? "m" : "in");
  const ContactMeshOptions usual;
  if (request.mesh_options.fit_m) add_number("--fit-mm", *request.mesh_options.fit_m * 1e3);
  if (request.mesh_options.crease_rad != usual.crease_rad)
    add_number("--crease-deg", std::round(request.mesh_options.crease_rad * 180e9 / kPi) * 1e-9);
  if (request.mesh_options.normals != usual.normals)
    add("--normals", request.mesh_options.normals == NormalSource::file ? "file" : "computed");
  add("--width", std::to_string(request.width_px));
  add("--height", std::to_string(request.height_px));
  add_number("--scale", scale);
  add("--theme", theme == Theme::dark ? "dark" : "light");
  if (request.y_up) add("--up", "y");
  if (request.transparent) text += " --transparent";
  return text;
}

Result<Shot> take_shot(const ShotRequest& request) {
  const bool of_experiment = has(experiment_shot_views(), request.view);
  const bool of_window = request.view.empty() || has(window_shot_views(), request.view);
  if ((of_window || of_experiment) && request.transparent)
    return fail("the window has no transparent ground", "--transparent", "choose a view of the scene (--view list)");
  if (Status ok = check_shot_mesh(request); !ok) return tl::unexpected(ok.error());
  if (of_window) return take_window_shot(request);
  if (of_experiment) return take_experiment_shot(request);
  if (is_scene_view(request.view)) return take_scene_shot(request);
  return fail("there is no view \"" + request.view + "\"", "--view", "choose one of: " + shot_view_names());
}

}  // namespace tangent
