#include "core/io/mesh_io.h"
#include "core/io/pose_file.h"
#include "core/io/preset_file.h"
#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "workbench/embed/c_handle.h"
#include "workbench/embed/tangent_c.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;
using tangent::testing::TempFolder;

namespace {

/// What a test makes through the interface, freed at its end.
struct Handles {
  tangent_scene* scene = nullptr;
  tangent_preset* preset = nullptr;
  tangent_stepper* stepper = nullptr;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    tangent_free_stepper(stepper);
    tangent_free_preset(preset);
    tangent_free_scene(scene);
  }
};

std::string sphere_file(const TempFolder& folder) {
  const std::string path = (folder.path() / "sphere.obj").string();
  REQUIRE(write_obj(*generate_mesh("sphere"), path, 1e-3));
  return path;
}

/// A sphere, the built-in preset, and a stepper.
void make_sphere(const TempFolder& folder, Handles& made) {
  REQUIRE(tangent_load_scene(TANGENT_C_VERSION, sphere_file(folder).c_str(), nullptr, &made.scene) == TANGENT_OK);
  REQUIRE(tangent_make_preset(TANGENT_C_VERSION, &made.preset) == TANGENT_OK);
  REQUIRE(tangent_make_stepper(made.scene, &made.stepper) == TANGENT_OK);
}

tangent_input pose_at(double t_s, double x_m, double z_m) {
  tangent_input in = TANGENT_INPUT_INIT;
  in.t_s = t_s;
  in.position_m[0] = x_m, in.position_m[2] = z_m;
  return in;
}

/// Over the top of the sphere, 1 mm deep at first.
std::vector<tangent_input> path_over_sphere(int ticks) {
  std::vector<tangent_input> path;
  for (int i = 0; i < ticks; ++i) path.push_back(pose_at(1e-3 * i, 1e-4 * i, 0.059));
  return path;
}

std::vector<tangent_output> room_for(std::size_t count) {
  const tangent_output empty = TANGENT_OUTPUT_INIT;
  return std::vector<tangent_output>(count, empty);
}

void check_same(const std::vector<tangent_output>& a, const std::vector<tangent_output>& b) {
  REQUIRE(a.size() == b.size());
  CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(tangent_output)) == 0);
}

bool says(const char* text, const char* words) { return std::string(text).find(words) != std::string::npos; }

}  // namespace

TEST_CASE("a tick in C is the tick in C++, and many in turn are those one by one") {
  const TempFolder folder;
  Handles made;
  make_sphere(folder, made);
  const std::vector<tangent_input> path = path_over_sphere(50);
  std::vector<tangent_output> singly = room_for(path.size()), together = room_for(path.size());
  Stepper stepper(made.scene->scene);
  TickState state;
  for (std::size_t i = 0; i < path.size(); ++i) {
    REQUIRE(tangent_step(made.stepper, made.preset, &path[i], &singly[i]) == TANGENT_OK);
    TickInput in;
    in.t_s = path[i].t_s;
    in.finger.position = {path[i].position_m[0], 0.0, path[i].position_m[2]};
    const TickOutput out = stepper.step(Preset{}, in, state);
    CHECK(singly[i].penetration_m == out.penetration_m);
    CHECK(singly[i].force_n[0] == out.force_n.x);
    CHECK(singly[i].cld_m == out.cld_m);
    CHECK(singly[i].triangle == static_cast<std::int32_t>(out.triangle));
    CHECK(singly[i].status == static_cast<std::int32_t>(out.status));
    CHECK(singly[i].tick == i);
  }
  CHECK(singly[0].penetration_m == approx(1e-3));
  CHECK(singly[0].status == TANGENT_FACE);
  REQUIRE(tangent_reset(made.stepper) == TANGENT_OK);
  REQUIRE(tangent_step_many(made.stepper, made.preset, path.data(), together.data(), path.size()) == TANGENT_OK);
  check_same(singly, together);
}

TEST_CASE("fingers on several threads give the bits of one stepper after the other") {
  const TempFolder folder;
  Handles made;
  make_sphere(folder, made);
  constexpr std::size_t kFingers = 9, kTicks = 20;
  std::vector<tangent_input> inputs;
  for (std::size_t f = 0; f < kFingers; ++f)
    for (const tangent_input& in : path_over_sphere(kTicks)) {
      inputs.push_back(in);
      inputs.back().position_m[1] = 1e-3 * static_cast<double>(f);
    }
  std::vector<tangent_output> alone = room_for(inputs.size());
  for (std::size_t f = 0; f < kFingers; ++f) {
    REQUIRE(tangent_reset(made.stepper) == TANGENT_OK);
    REQUIRE(tangent_step_many(made.stepper, made.preset, &inputs[f * kTicks], &alone[f * kTicks], kTicks) ==
            TANGENT_OK);
  }
  for (const std::uint32_t threads : {0u, 1u, 4u, 64u}) {
    std::vector<tangent_output> at_once = room_for(inputs.size());
    REQUIRE(tangent_solve_fingers(made.stepper, made.preset, inputs.data(), at_once.data(), kFingers, kTicks,
                                  threads) == TANGENT_OK);
    check_same(alone, at_once);
  }
}

TEST_CASE("a handle that could not be made says what, where and what to do, and is freed like any other") {
  const TempFolder folder;
  Handles made;
  CHECK(tangent_load_scene(TANGENT_C_VERSION, "/nowhere/mesh.obj", nullptr, &made.scene) == TANGENT_FAILED);
  CHECK(says(tangent_scene_error(made.scene), "/nowhere/mesh.obj"));
  CHECK(tangent_make_stepper(made.scene, &made.stepper) == TANGENT_NULL);
  CHECK(made.stepper == nullptr);
  const std::string newer = (folder.path() / "newer.toml").string();
  std::ofstream(newer) << "format = 99\n";
  CHECK(tangent_read_preset(TANGENT_C_VERSION, newer.c_str(), &made.preset) == TANGENT_FAILED);
  CHECK(says(tangent_preset_error(made.preset), "newer.toml"));
  double value = 0.0;
  CHECK(tangent_get_value(made.preset, "solver.gain_overall", &value) == TANGENT_NULL);
}

TEST_CASE("a preset of rubbish is an error, not an exception") {
  const TempFolder folder;
  Handles made;
  const std::string broken = (folder.path() / "broken.toml").string();
  std::ofstream(broken) << "[solver\nmethod = = \x01\x02\n";
  CHECK(tangent_read_preset(TANGENT_C_VERSION, broken.c_str(), &made.preset) == TANGENT_FAILED);
  CHECK(says(tangent_preset_error(made.preset), "broken.toml"));
}

TEST_CASE("programs of another version are refused, and patches of the same one are not") {
  const TempFolder folder;
  const std::string path = sphere_file(folder);
  Handles other, patched;
  CHECK(tangent_load_scene(TANGENT_C_VERSION + 100, path.c_str(), nullptr, &other.scene) == TANGENT_BAD_VERSION);
  CHECK(says(tangent_scene_error(other.scene), "compiled for tangent 0.2.0, and this library is 0.1.0"));
  CHECK(says(tangent_scene_error(other.scene), "install"));
  CHECK(tangent_make_preset(TANGENT_C_VERSION + 10000, &other.preset) == TANGENT_BAD_VERSION);
  CHECK(tangent_load_scene(TANGENT_C_VERSION + 7, path.c_str(), nullptr, &patched.scene) == TANGENT_OK);
  CHECK(tangent_library_version() == TANGENT_C_VERSION);
}

TEST_CASE("structs of another size are refused wherever they come in") {
  const TempFolder folder;
  Handles made, other;
  make_sphere(folder, made);
  tangent_scene_options options = TANGENT_SCENE_OPTIONS_INIT;
  options.size += 8;
  CHECK(tangent_load_scene(TANGENT_C_VERSION, sphere_file(folder).c_str(), &options, &other.scene) == TANGENT_BAD_SIZE);
  CHECK(says(tangent_scene_error(other.scene), "tangent_scene_options"));
  tangent_input in = pose_at(0.0, 0.0, 0.059);
  tangent_output out = TANGENT_OUTPUT_INIT;
  in.size = 0;
  CHECK(tangent_step(made.stepper, made.preset, &in, &out) == TANGENT_BAD_SIZE);
  CHECK(says(tangent_stepper_error(made.stepper), "tangent_input: size is 0 bytes"));
  in.size = sizeof in;
  out.size = 4;
  CHECK(tangent_step(made.stepper, made.preset, &in, &out) == TANGENT_BAD_SIZE);
  tangent_mesh_audit audit = TANGENT_MESH_AUDIT_INIT;
  audit.size = 1;
  CHECK(tangent_audit(made.scene, &audit) == TANGENT_BAD_SIZE);
  tangent_scene_info info = TANGENT_SCENE_INFO_INIT;
  info.size = 1;
  CHECK(tangent_get_scene_info(made.scene, &info) == TANGENT_BAD_SIZE);
}

TEST_CASE("a pose that can't be used is named, and nothing is computed") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  const TempFolder folder;
  Handles made;
  make_sphere(folder, made);
  std::vector<tangent_input> path = path_over_sphere(5);
  std::vector<tangent_output> out = room_for(path.size());
  const std::vector<tangent_output> untouched = out;
  const auto fails = [&](const char* words) {
    CHECK(tangent_step_many(made.stepper, made.preset, path.data(), out.data(), path.size()) == TANGENT_BAD_POSE);
    CHECK(says(tangent_stepper_error(made.stepper), words));
    check_same(out, untouched);
    path = path_over_sphere(5);
  };
  path[3].position_m[1] = kNan;
  fails("pose 3: position_m is not finite");
  path[4].t_s = kInf;
  fails("pose 4: t_s");
  path[0].orientation_wxyz[0] = 0.5;
  fails("pose 0: orientation_wxyz");
  path[1].orientation_wxyz[2] = kNan;
  fails("pose 1: orientation_wxyz");
  path[2].has_velocity = 1;
  path[2].velocity_m_per_s[0] = kNan;
  fails("pose 2: velocity");
  CHECK(tangent_step_many(made.stepper, made.preset, path.data(), out.data(), path.size()) == TANGENT_OK);
  CHECK(std::string(tangent_stepper_error(made.stepper)).empty());
}

TEST_CASE("null handles and pointers are an error value in every call") {
  const TempFolder folder;
  Handles made;
  make_sphere(folder, made);
  tangent_input in = TANGENT_INPUT_INIT;
  tangent_output out = TANGENT_OUTPUT_INIT;
  tangent_mesh_audit audit = TANGENT_MESH_AUDIT_INIT;
  tangent_scene_info info = TANGENT_SCENE_INFO_INIT;
  double value = 0.0;
  CHECK(tangent_load_scene(TANGENT_C_VERSION, "x.obj", nullptr, nullptr) == TANGENT_NULL);
  CHECK(tangent_read_preset(TANGENT_C_VERSION, "x.toml", nullptr) == TANGENT_NULL);
  CHECK(tangent_make_preset(TANGENT_C_VERSION, nullptr) == TANGENT_NULL);
  tangent_stepper* none = nullptr;
  CHECK(tangent_make_stepper(nullptr, &none) == TANGENT_NULL);
  CHECK(tangent_make_stepper(made.scene, nullptr) == TANGENT_NULL);
  CHECK(tangent_step(nullptr, made.preset, &in, &out) == TANGENT_NULL);
  CHECK(tangent_step(made.stepper, nullptr, &in, &out) == TANGENT_NULL);
  CHECK(tangent_step(made.stepper, made.preset, nullptr, &out) == TANGENT_NULL);
  CHECK(tangent_step(made.stepper, made.preset, &in, nullptr) == TANGENT_NULL);
  CHECK(tangent_solve_fingers(nullptr, made.preset, &in, &out, 1, 1, 1) == TANGENT_NULL);
  CHECK(tangent_reset(nullptr) == TANGENT_NULL);
  CHECK(tangent_audit(nullptr, &audit) == TANGENT_NULL);
  CHECK(tangent_audit(made.scene, nullptr) == TANGENT_NULL);
  CHECK(tangent_decimate(nullptr, nullptr, nullptr) == TANGENT_NULL);
  CHECK(tangent_get_scene_info(nullptr, &info) == TANGENT_NULL);
  CHECK(tangent_write_mesh(nullptr, "x.obj", 1.0) == TANGENT_NULL);
  CHECK(tangent_write_preset(nullptr, "x.toml") == TANGENT_NULL);
  CHECK(tangent_get_value(made.preset, nullptr, &value) == TANGENT_NULL);
  CHECK(tangent_set_value(nullptr, "solver.gain_overall", 1.0) == TANGENT_NULL);
  CHECK(tangent_preset_choice(nullptr, 0) == nullptr);
  CHECK(says(tangent_stepper_error(nullptr), "null"));
  CHECK(says(tangent_scene_error(nullptr), "null"));
  CHECK(says(tangent_preset_error(nullptr), "null"));
  tangent_free_scene(nullptr), tangent_free_preset(nullptr), tangent_free_stepper(nullptr);
}

TEST_CASE("a folder, or nothing, in place of a file is an error that names it") {
  const TempFolder folder;
  const std::string path = folder.path().string();
  Handles made, empty;
  CHECK(tangent_load_scene(TANGENT_C_VERSION, (path + "/.").c_str(), nullptr, &made.scene) == TANGENT_FAILED);
  CHECK(says(tangent_scene_error(made.scene), path.c_str()));
  CHECK(tangent_read_preset(TANGENT_C_VERSION, path.c_str(), &made.preset) == TANGENT_FAILED);
  CHECK(says(tangent_preset_error(made.preset), path.c_str()));
  CHECK(tangent_load_scene(TANGENT_C_VERSION, "", nullptr, &empty.scene) == TANGENT_FAILED);
  CHECK(tangent_read_preset(TANGENT_C_VERSION, nullptr, &empty.preset) == TANGENT_NULL);
  CHECK(says(tangent_preset_error(empty.preset), "path is null"));
  CHECK(tangent_write_preset(made.preset, "x.toml") == TANGENT_NULL);
  Handles good;
  make_sphere(folder, good);
  CHECK(tangent_write_preset(good.preset, path.c_str()) == TANGENT_FAILED);
  CHECK(says(tangent_preset_error(good.preset), path.c_str()));
  CHECK(tangent_write_mesh(good.scene, path.c_str(), 1e-3) == TANGENT_FAILED);
  CHECK(tangent_write_mesh(good.scene, "/nowhere/x.obj", 1e-3) == TANGENT_FAILED);
}

TEST_CASE("counts that no array has are refused before anything is read") {
  const TempFolder folder;
  Handles made;
  make_sphere(folder, made);
  const tangent_input in = pose_at(0.0, 0.0, 0.059);
  tangent_output out = TANGENT_OUTPUT_INIT;
  const auto minus = [](int n) { return static_cast<std::size_t>(-n); };
  for (const std::size_t count : {minus(1), minus(1000), SIZE_MAX / 2, SIZE_MAX / 100}) {
    CHECK(tangent_step_many(made.stepper, made.preset, &in, &out, count) == TANGENT_FAILED);
    CHECK(says(tangent_stepper_error(made.stepper), "negative"));
    CHECK(tangent_solve_fingers(made.stepper, made.preset, &in, &out, count, 1, 1) == TANGENT_FAILED);
    CHECK(tangent_solve_fingers(made.stepper, made.preset, &in, &out, 1, count, 1) == TANGENT_FAILED);
    CHECK(tangent_solve_fingers(made.stepper, made.preset, &in, &out, count, count, 1) == TANGENT_FAILED);
    CHECK(out.tick == 0);
  }
  CHECK(tangent_solve_fingers(made.stepper, made.preset, nullptr, nullptr, 0, 7, 1) == TANGENT_OK);
  CHECK(tangent_solve_fingers(made.stepper, made.preset, nullptr, nullptr, 7, 0, 1) == TANGENT_OK);
  CHECK(tangent_solve_fingers(made.stepper, made.preset, &in, &out, 1, 1, UINT32_MAX) == TANGENT_OK);
}

TEST_CASE("two scenes and two presets do not know of each other") {
  const TempFolder folder;
  Handles sphere, cube;
  make_sphere(folder, sphere);
  const std::string path = (folder.path() / "cube.obj").string();
  REQUIRE(write_obj(*generate_mesh("cube"), path, 1e-3));
  REQUIRE(tangent_load_scene(TANGENT_C_VERSION, path.c_str(), nullptr, &cube.scene) == TANGENT_OK);
  REQUIRE(tangent_make_stepper(cube.scene, &cube.stepper) == TANGENT_OK);
  const std::vector<tangent_input> path_in = path_over_sphere(40);
  std::vector<tangent_output> alone = room_for(40), mixed = room_for(40);
  REQUIRE(tangent_step_many(sphere.stepper, sphere.preset, path_in.data(), alone.data(), 40) == TANGENT_OK);
  REQUIRE(tangent_reset(sphere.stepper) == TANGENT_OK);
  tangent_free_scene(sphere.scene), sphere.scene = nullptr;  // its stepper lives on
  tangent_output other = TANGENT_OUTPUT_INIT;
  for (std::size_t i = 0; i < 40; ++i) {
    REQUIRE(tangent_step(sphere.stepper, sphere.preset, &path_in[i], &mixed[i]) == TANGENT_OK);
    REQUIRE(tangent_step(cube.stepper, sphere.preset, &path_in[i], &other) == TANGENT_OK);
  }
  check_same(alone, mixed);
}

TEST_CASE("a second thread in a stepper is told so, and disturbs nothing") {
  const TempFolder folder;
  Handles made;
  make_sphere(folder, made);
  const tangent_input in = pose_at(0.0, 0.0, 0.059);
  tangent_output out = TANGENT_OUTPUT_INIT;
  made.stepper->in_use = true;  // as if another were in the middle of a tick
  CHECK(tangent_step(made.stepper, made.preset, &in, &out) == TANGENT_BUSY);
  CHECK(tangent_reset(made.stepper) == TANGENT_BUSY);
  CHECK(tangent_solve_fingers(made.stepper, made.preset, &in, &out, 1, 1, 1) == TANGENT_BUSY);
  CHECK(says(tangent_status_text(TANGENT_BUSY), "one stepper per thread"));
  made.stepper->in_use = false;
  CHECK(tangent_step(made.stepper, made.preset, &in, &out) == TANGENT_OK);
  CHECK(out.tick == 0);
}

TEST_CASE("values of a preset are set within their ranges, and are read back from its file") {
  const TempFolder folder;
  Handles made, again;
  REQUIRE(tangent_make_preset(TANGENT_C_VERSION, &made.preset) == TANGENT_OK);
  CHECK(tangent_set_value(made.preset, "solver.gain_overall", 0.75) == TANGENT_OK);
  CHECK(tangent_set_value(made.preset, "solver.gain_overall", -1.0) == TANGENT_FAILED);
  CHECK(says(tangent_preset_error(made.preset), "allowed: "));
  CHECK(tangent_set_value(made.preset, "solver.no_such", 1.0) == TANGENT_FAILED);
  CHECK(says(tangent_preset_error(made.preset), "solver.no_such"));
  CHECK(tangent_set_value(made.preset, "force.stiffness_n_per_m", std::nan("")) == TANGENT_FAILED);
  REQUIRE(std::string(tangent_preset_choice("solver.method", 1)) == "newton");
  CHECK(tangent_set_value(made.preset, "solver.method", 1.0) == TANGENT_OK);
  CHECK(tangent_preset_choice("solver.gain_overall", 0) == nullptr);
  const std::string path = (folder.path() / "mine.toml").string();
  REQUIRE(tangent_write_preset(made.preset, path.c_str()) == TANGENT_OK);
  REQUIRE(tangent_read_preset(TANGENT_C_VERSION, path.c_str(), &again.preset) == TANGENT_OK);
  int keys = 0;
  for (std::size_t i = 0; const char* key = tangent_preset_key(i); ++i, ++keys) {
    double a = 0.0, b = 1.0;
    REQUIRE(tangent_get_value(made.preset, key, &a) == TANGENT_OK);
    REQUIRE(tangent_get_value(again.preset, key, &b) == TANGENT_OK);
    CHECK(a == b);
  }
  CHECK(keys > 20);
}

TEST_CASE("meshes are audited, decimated and written through the C interface") {
  const TempFolder folder;
  Handles made, coarse, again;
  make_sphere(folder, made);
  tangent_mesh_audit audit = TANGENT_MESH_AUDIT_INIT;
  REQUIRE(tangent_audit(made.scene, &audit) == TANGENT_OK);
  CHECK(audit.triangles == 320);
  CHECK(audit.components == 1);
  CHECK(audit.boundary_edges == 0);
  tangent_decimate_options options = TANGENT_DECIMATE_OPTIONS_INIT;
  options.angle_deg = 60.0, options.deviation_m = 5e-3;
  REQUIRE(tangent_decimate(made.scene, &options, &coarse.scene) == TANGENT_OK);
  tangent_scene_info info = TANGENT_SCENE_INFO_INIT;
  REQUIRE(tangent_get_scene_info(coarse.scene, &info) == TANGENT_OK);
  CHECK(info.triangles < 320);
  CHECK(info.planar == 0);
  const std::string path = (folder.path() / "coarse.obj").string();
  REQUIRE(tangent_write_mesh(coarse.scene, path.c_str(), 1e-3) == TANGENT_OK);
  REQUIRE(tangent_load_scene(TANGENT_C_VERSION, path.c_str(), nullptr, &again.scene) == TANGENT_OK);
  tangent_scene_info read = TANGENT_SCENE_INFO_INIT;
  REQUIRE(tangent_get_scene_info(again.scene, &read) == TANGENT_OK);
  CHECK(read.triangles == info.triangles);
  options.angle_deg = -1.0;
  Handles refused;
  CHECK(tangent_decimate(made.scene, &options, &refused.scene) == TANGENT_FAILED);
}

TEST_CASE("a 2D scene takes round fingers, and has no mesh to audit") {
  const TempFolder folder;
  Handles made;
  const std::string path = (folder.path() / "outline.csv").string();
  std::ofstream(path) << "x_m,y_m\n0.03,-0.02\n0.03,0.02\n-0.03,0.02\n-0.03,-0.02\n0.03,-0.02\n";
  REQUIRE(tangent_load_scene(TANGENT_C_VERSION, path.c_str(), nullptr, &made.scene) == TANGENT_OK);
  REQUIRE(tangent_make_preset(TANGENT_C_VERSION, &made.preset) == TANGENT_OK);
  REQUIRE(tangent_make_stepper(made.scene, &made.stepper) == TANGENT_OK);
  tangent_input in = TANGENT_INPUT_INIT;
  in.position_m[1] = 0.039;
  tangent_output out = TANGENT_OUTPUT_INIT;
  CHECK(tangent_step(made.stepper, made.preset, &in, &out) == TANGENT_OK);
  CHECK(out.penetration_m == approx(1e-3));
  tangent_mesh_audit audit = TANGENT_MESH_AUDIT_INIT;
  CHECK(tangent_audit(made.scene, &audit) == TANGENT_FAILED);
  REQUIRE(tangent_set_value(made.preset, "finger.shape", 3.0) == TANGENT_OK);
  CHECK(tangent_step(made.stepper, made.preset, &in, &out) == TANGENT_FAILED);
  CHECK(says(tangent_stepper_error(made.stepper), "finger.shape"));
}
