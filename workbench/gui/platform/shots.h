// Pictures by name, no display needed: the window as a user sees it, and the 3D view alone. Deterministic:
// simulated time, fixed seeds, the best rendering quality.
#pragma once

#include "core/base/result.h"
#include "core/mesh/contact_mesh.h"
#include "workbench/gui/render/image.h"
#include "workbench/gui/theme/palette.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

struct ShotView {
  std::string name;
  std::string shows;  ///< one line
};
const std::vector<ShotView>& shot_views();
/// Names for messages: "overview light iterations ...".
std::string shot_view_names();

struct ShotRequest {
  std::string view;
  std::string mesh;  ///< file or generated object; empty: the view's own
  double metres_per_unit = 1e-3;
  ContactMeshOptions mesh_options;
  std::filesystem::path preset;  ///< of the window views; empty: the program's own values
  int width_px = 1280, height_px = 720;
  std::optional<double>
      scale;          ///< of fonts, lines and spacing; none: 1 for the window, of the scene what fits its height
  bool y_up = false;  ///< the mesh stands on y, as many scans do
  std::optional<Theme> theme;  ///< none: the view's own
};

/// Fails on an unknown view (naming them), a mesh or preset that can't be used, or without off-screen GL.
Result<Image> take_shot(const ShotRequest& request);

}  // namespace tangent
