// A scene from a file: what a program that embeds the core begins with.
#pragma once

#include "core/base/result.h"
#include "core/tick/scene.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace tangent {

struct SceneOptions {
  double metres_per_unit = 1e-3;  ///< of the file's coordinates; 1e-3: millimetres
  ContactMeshOptions mesh{};      ///< size, normals, creases; of a polygon only the size counts
  SceneParts parts{};             ///< what is built now; by default all that any tick may read
};

/// A mesh (.obj, .ply, .stl, .off) as a 3D scene, a polygon (.csv, or an .obj with a line element) as a 2D one; in
/// metres. The scene is immutable: share it between threads, with a Stepper for each. Errors name the file and its line
/// or element, or the mesh's defect, and what to do. `run_both` may build two structures at once (ContactScene::build).
Result<std::shared_ptr<const ContactScene>> load_scene(const std::filesystem::path& path,
                                                       const SceneOptions& options = {},
                                                       const RunBoth& run_both = run_in_turn);

struct SceneFile {
  std::shared_ptr<const ContactScene> scene;
  std::shared_ptr<const PolygonMesh> source;  ///< the mesh as the file holds it; null: a polygon
};

/// As load_scene, and keeps what was read, for audits.
Result<SceneFile> read_scene(const std::filesystem::path& path, const SceneOptions& options = {},
                             const RunBoth& run_both = run_in_turn);
/// What reads a mesh's content beside the building of its scene, in another thread.
struct BesideContent {
  ContactMesh::OnContent begin;  ///< once there is a content: never for a polygon
  std::function<void()> end;     ///< waits for that; called before the content may end with an error
};
Result<SceneFile> read_scene(const std::filesystem::path& path, const SceneOptions& options, const RunBoth& run_both,
                             const BesideContent& beside);

}  // namespace tangent
