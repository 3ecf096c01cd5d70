// The shader programs of the 3D view and their common uniforms: matrices and the light's up direction.
#pragma once

#include "workbench/gui/render/camera.h"
#include "workbench/gui/render/shader_program.h"
#include "workbench/gui/theme/palette.h"

#include <array>

namespace tangent {

struct ScenePrograms {
  ShaderProgram background, facets, surface, strokes, fills, solid;
  std::string error;          ///< of the last reload; empty: none
  std::uint64_t version = 0;  ///< counts successful reloads

  Status load();
  void reload_changed();

 private:
  struct Named {
    const char* name;
    ShaderProgram* program;
  };
  std::array<Named, 6> all();
};

/// Matrices for positions in units of `scale_m` relative to `origin` (world). Scaling does not change the image but
/// keeps floats near one for a scene of any size.
struct ViewMatrices {
  ViewMatrices(const Camera& camera, const Vec3& origin, double scale_m, int width_px, int height_px);
  /// Sets model_view, projection and up_eye of the program in use.
  void apply(const ShaderProgram& program) const;

  glm::mat4 model_view, projection;
  glm::vec3 up_eye;
  glm::vec2 view_px;
};

inline glm::vec3 rgb(Rgba c) { return {c.r, c.g, c.b}; }
inline glm::vec4 rgba(Rgba c) { return {c.r, c.g, c.b, c.a}; }

}  // namespace tangent
