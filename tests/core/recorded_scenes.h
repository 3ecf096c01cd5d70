// Scenes that once showed a defect: a mesh and the path of a finger over it (tests/assets/scenes).
#pragma once

#include "core/io/mesh_io.h"
#include "core/io/pose_file.h"
#include "tests/core/scenes.h"
#include "tests/support/paths.h"

namespace tangent::test {

struct RecordedScene {
  ScenePtr scene;
  std::vector<TickInput> poses;
};

/// By the name of its path. Its mesh is the file of that name, or a generated one.
inline RecordedScene recorded_scene(const std::string& name) {
  const std::filesystem::path folder = testing::test_assets() + "/scenes";
  const std::string object = name == "cube_crease" ? "cube" : name;
  const std::filesystem::path file = folder / (object + ".obj");
  const auto mesh = std::filesystem::exists(file) ? read_mesh(file, 1e-3) : generate_mesh(object);
  REQUIRE_MESSAGE(mesh.has_value(), (mesh ? "" : mesh.error().message()));
  const auto poses = read_poses(folder / (name + ".csv"));
  REQUIRE_MESSAGE(poses.has_value(), (poses ? "" : poses.error().message()));
  return {scene_of(*mesh), *poses};
}

}  // namespace tangent::test
