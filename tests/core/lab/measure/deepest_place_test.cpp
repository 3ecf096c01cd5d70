// The tracked contact is the deepest one: a search without kept state at the same pose must not find a deeper place.
#include "core/base/tolerances.h"
#include "tests/core/scenes.h"

#include <fstream>
#include <sstream>

using namespace tangent;
using namespace tangent::test;

namespace {

std::vector<TickInput> poses_of(const std::filesystem::path& path) {
  std::vector<TickInput> poses;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream values(line);
    double t = 0.0, x = 0.0, y = 0.0, z = 0.0;
    char comma = 0;
    values >> t >> comma >> x >> comma >> y >> comma >> z;
    poses.push_back(at_position(t, {x, y, z}));
  }
  return poses;
}

/// Poses of a sphere finger of that radius over the mesh, with and without creases.
void check_deepest(const std::filesystem::path& mesh, const std::vector<TickInput>& poses, double radius) {
  for (const double crease_deg : {45.0, 180.0}) {
    const ScenePtr scene = file_scene(mesh, crease_deg);
    const Preset preset = sphere_preset(radius, Method::robust);
    Stepper tracking(scene), searching(scene);
    TickState state;
    int shallower = 0, late = 0, unconverged = 0;
    for (const TickInput& input : poses) {
      const TickOutput tracked = tracking.step(preset, input, state);
      unconverged += tracked.status == TickStatus::unconverged;
      TickState fresh;
      const TickOutput cold = searching.step(preset, input, fresh);
      // The hysteresis may hold a place that is shallower by that much, and a rival's height is guessed to
      // kHeightGuess.
      const double behind =
          cold.penetration_m - tracked.penetration_m - preset.solver.switch_hysteresis_m - preset.solver.tolerance_m;
      late += behind > 0.0;
      shallower += behind > 2.0 * kHeightGuess * radius;
    }
    MESSAGE(mesh.stem().string() << ", " << radius << " m, creases " << crease_deg << ": " << unconverged << " of "
                                 << poses.size() << " ticks unconverged, " << late << " behind a deeper place, "
                                 << shallower << " by more than heights are guessed to");
    CHECK(unconverged == 0);
    CHECK(shallower == 0);
  }
}

constexpr std::pair<const char*, double> kFingers[] = {{"-r005.csv", 0.005}, {"-r020.csv", 0.020}};

}  // namespace

TEST_CASE("on spot the tracked contact is the deepest place, as a search from nothing finds it") {
  for (const auto& [finger, radius] : kFingers) {
    std::vector<TickInput> poses = poses_of(TANGENT_TEST_ASSETS "/poses/spot" + std::string(finger));
    REQUIRE(poses.size() == 600);
    check_deepest(testing::spot_file(), poses, radius);
  }
}

TEST_CASE("on real meshes the tracked contact is the deepest place, as a search from nothing finds it") {
  if (!testing::shared_files_there({"meshes/spot.obj", "meshes/fandisk.obj", "meshes/stanford-bunny.obj", "poses"}))
    return;
  for (const std::string name : {"spot", "fandisk", "stanford-bunny"}) {
    for (const auto& [finger, radius] : kFingers) {
      std::vector<TickInput> poses = poses_of(testing::shared_file("poses/" + name + finger));
      REQUIRE(poses.size() == 20000);
      poses.resize(static_cast<std::size_t>(rounds(20000)));
      check_deepest(testing::shared_file("meshes/" + name + ".obj"), poses, radius);
    }
  }
}
