#include "core/io/scene_file.h"

#include "core/io/mesh_io.h"
#include "core/io/preset_file.h"
#include "core/lab/objects/generate.h"
#include "core/tick/step.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

using namespace tangent;
using namespace tangent::test;
using tangent::testing::TempFolder;
namespace fs = std::filesystem;

TEST_CASE("a scene from a file is the one built step by step") {
  const TempFolder folder;
  const std::string path = folder.file("torus.obj");
  REQUIRE(write_obj(*generate_mesh("torus"), path, 1e-3));
  SceneOptions options;
  options.mesh.fit_m = 0.05;
  const auto file = read_scene(path, options);
  REQUIRE(file);
  const auto source = read_mesh(path, 1e-3);
  const auto mesh = ContactMesh::build(*source, options.mesh);
  CHECK(file->scene->mesh().content_hash() == mesh->content_hash());
  CHECK(file->scene->has_hierarchy());
  CHECK(file->source->positions == source->positions);
  const double as_millimetres = (*load_scene(path))->mesh().bounds().size().x;
  const double as_metres = (*load_scene(path, {.metres_per_unit = 1.0}))->mesh().bounds().size().x;
  CHECK(as_metres == approx(1e3 * as_millimetres));
}

TEST_CASE("the first contact with the core is one file and one pose") {
  const TempFolder folder;
  const std::string path = folder.file("sphere.obj");
  REQUIRE(write_obj(*generate_mesh("sphere"), path, 1e-3));
  REQUIRE(write_preset({}, folder.file("default.toml")));
  const auto scene = load_scene(path);
  const auto preset = read_preset(folder.file("default.toml"));
  REQUIRE(scene);
  REQUIRE(preset);
  Stepper stepper(*scene);
  TickState state;
  TickInput in;
  in.finger.position = {0.0, 0.0, 0.059};
  CHECK(stepper.step(*preset, in, state).penetration_m == approx(1e-3));
}

TEST_CASE("a mesh is read beside the building of its scene, and no longer where that might fail") {
  const TempFolder folder;
  const std::string path = folder.file("ball.obj");
  REQUIRE(write_obj(make_icosphere(0.04, 3), path, 1e-3));
  for (const bool in_parts : {false, true}) {
    std::uint64_t hash = 0;
    int ends = 0;
    SceneOptions options;
    if (in_parts) options.parts.whole_up_to = 0;
    const auto file = read_scene(path, options, run_in_turn,
                                 {[&](const MeshContent& content) { hash = content.hash(); }, [&] { ++ends; }});
    REQUIRE(file);
    CHECK(hash == file->scene->mesh().content_hash());
    CHECK(ends == (in_parts ? 0 : 1));
  }
}

TEST_CASE("a polygon becomes a 2D scene") {
  const TempFolder folder;
  const std::string path =
      folder.write("outline.csv", "x_m,y_m\n0.03,-0.02\n0.03,0.02\n-0.03,0.02\n-0.03,-0.02\n0.03,-0.02\n");
  const auto file = read_scene(path);
  REQUIRE(file);
  CHECK(file->scene->planar() != nullptr);
  CHECK(file->source == nullptr);
}

TEST_CASE("what can't be a scene is an error that names the file") {
  const TempFolder folder;
  const std::string missing = folder.file("missing.obj");
  const std::string flat = folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const std::string crossed = folder.write("crossed.csv", "x_m,y_m\n0,0\n");
  for (const std::string& path : {missing, flat, crossed}) {
    const auto scene = load_scene(path);
    CAPTURE(path);
    REQUIRE(!scene);
    CHECK(scene.error().message().find(fs::path(path).filename().string()) != std::string::npos);
    CHECK(!scene.error().what.empty());
  }
}
