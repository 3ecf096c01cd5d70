#include "workbench/gui/render/scene_programs.h"

namespace tangent {

std::array<ScenePrograms::Named, 6> ScenePrograms::all() {
  return {{{"background", &background},
           {"facets", &facets},
           {"surface", &surface},
           {"strokes", &strokes},
           {"fills", &fills},
           {"solid", &solid}}};
}

Status ScenePrograms::load() {
  const Result<std::filesystem::path> directory = find_shader_directory();
  if (!directory) return tl::unexpected(directory.error());
  for (const Named& entry : all()) {
    Result<ShaderProgram> program = ShaderProgram::load(*directory, entry.name);
    if (!program) return tl::unexpected(program.error());
    *entry.program = std::move(*program);
  }
  return {};
}

void ScenePrograms::reload_changed() {
  for (const Named& entry : all()) {
    const unsigned before = entry.program->id();
    const Status done = entry.program->reload_if_changed();
    if (!done) error = done.error().message();
    if (entry.program->id() == before) continue;
    ++version;
    error.clear();
  }
}

ViewMatrices::ViewMatrices(const Camera& camera, const Vec3& origin, double scale_m, int width_px, int height_px)
    : view_px(width_px, height_px) {
  glm::dmat4 view = camera.view_from(origin);
  glm::dmat4 project = camera.projection(width_px, height_px);
  for (int i = 0; i < 3; ++i) view[3][i] /= scale_m;
  project[3][2] /= scale_m;  // the only entry with a unit
  model_view = glm::mat4(view);
  projection = glm::mat4(project);
  const Vec3 up = camera.y_up ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  up_eye = glm::vec3(glm::dmat3(view) * up);
}

void ViewMatrices::apply(const ShaderProgram& program) const {
  program.set("model_view", model_view);
  program.set("projection", projection);
  program.set("up_eye", up_eye);
  program.set("view_px", view_px);
}

}  // namespace tangent
