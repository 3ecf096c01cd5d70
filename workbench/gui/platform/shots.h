// Named screenshots without a display: the whole window, or the 3D view only. Deterministic: simulated time, fixed
// seeds, the best rendering quality.
#pragma once

#include "core/base/result.h"
#include "core/mesh/contact_mesh.h"
#include "workbench/gui/render/image.h"
#include "workbench/gui/theme/palette.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// What may be given to a view as its MESH.
enum class ShotTakes : std::uint8_t { mesh_or_polygon, mesh, polygon, nothing };

struct ShotView {
  std::string name;
  std::string shows;  ///< one line
  ShotTakes takes = ShotTakes::mesh_or_polygon;
};
const std::vector<ShotView>& shot_views();
/// Names for messages: "overview light iterations ...".
std::string shot_view_names();

struct ShotRequest {
  std::string view;              ///< empty with a script: the window as it starts
  std::filesystem::path script;  ///< commands to run in the window before the picture; empty: none
  std::string mesh;              ///< file or generated object; empty: the view's default
  double metres_per_unit = 1e-3;
  ContactMeshOptions mesh_options;
  std::filesystem::path preset;  ///< for window views; empty: default values
  int width_px = 1280, height_px = 720;
  std::optional<double> scale;  ///< of fonts, lines and spacing; empty: 1 for the window, by its height for the scene
  bool y_up = false;            ///< the mesh's up axis is y, as in many scans
  std::optional<Theme> theme;   ///< empty: the view's default
  bool transparent = false;     ///< nothing behind the scene; views of the scene only
  std::function<bool()> stop;   ///< asked while the window explores or runs a script; true: the shot fails
};

struct Shot {
  Image image;
  FileOrigin origin;  ///< its command gives the same picture again
};

/// Whether this view is one of the scene, not of the window.
bool is_scene_view(std::string_view view);
/// Fails where the view would not draw the mesh or polygon of the request; the error says what the view takes. Of an
/// unknown view, or without a mesh, there is nothing to say.
Status check_shot_mesh(const ShotRequest& request);
/// Whether this view is one of the window, in which a script can run.
bool is_window_view(std::string_view view);
/// The command that takes this shot, all defaults said, without the file that it goes to.
std::string shot_command(const ShotRequest& request, double scale, Theme theme);

/// Fails on an unknown view (the error lists them), an unusable mesh or preset, or without off-screen GL.
Result<Shot> take_shot(const ShotRequest& request);

}  // namespace tangent
