#include "workbench/gui/model/file_origin_of.h"

namespace tangent {

FileOrigin file_origin(const AppModel& model) {
  FileOrigin origin;
  const SceneModel& scene = model.scene();
  const PresetEditor& preset = model.presets().editor();
  origin.command = "workbench gui";
  if (scene.current() != nullptr && scene.current()->has_mesh()) {
    const ContactMesh& mesh = scene.current()->mesh();
    origin.mesh = mesh_fact(mesh.name(), mesh.triangle_count(), mesh.content_hash());
    origin.unit = unit_fact(scene.metres_per_unit());
  }
  if (!scene.path().empty()) origin.command += " " + shell_word(scene.path());
  if (!preset.path().empty()) origin.command += " --preset " + shell_word(preset.path().string());
  origin.preset = preset.name() + (preset.changed() ? ", changed since" : "");
  return origin;
}

}  // namespace tangent
