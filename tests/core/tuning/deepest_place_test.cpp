// Whether the tracked contact is the deepest one: a search from nothing at the same pose must not find a deeper place.
#include "tests/core/scenes.h"

#include <fstream>
#include <sstream>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr int kEvery = 20;  // poses between comparisons: a search from nothing takes milliseconds on 69k triangles

std::vector<TickInput> shared_poses(const std::string& name) {
  std::vector<TickInput> poses;
  std::ifstream file(std::filesystem::path(TANGENT_SHARED_ASSETS) / "poses" / name);
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

}  // namespace

TEST_CASE("on real meshes the tracked contact is the deepest place, as a search from nothing finds it") {
  for (const std::string name : {"spot", "fandisk", "stanford-bunny"}) {
    const ScenePtr scene = shared_scene(name + ".obj", 45.0);
    if (!scene) return;
    for (const auto& [file, radius] : {std::pair(name + "-r005.csv", 0.005), {name + "-r020.csv", 0.020}}) {
      const Preset preset = sphere_preset(radius, Method::robust);
      std::vector<TickInput> poses = shared_poses(file);
      REQUIRE(poses.size() == 20000);
      poses.resize(static_cast<std::size_t>(rounds(20000)));
      Stepper tracking(scene), searching(scene);
      TickState state;
      int compared = 0, misplaced = 0, unconverged = 0, tick = 0;
      for (const TickInput& input : poses) {
        const TickOutput tracked = tracking.step(preset, input, state);
        unconverged += tracked.status == TickStatus::unconverged;
        if (tick++ % kEvery != 0) continue;
        TickState fresh;
        const TickOutput cold = searching.step(preset, input, fresh);
        ++compared;
        // The hysteresis may hold a place that is shallower by that much.
        misplaced += cold.penetration_m > tracked.penetration_m + preset.solver.switch_hysteresis_m + preset.solver.tolerance_m;
      }
      MESSAGE(file << ": " << unconverged << " of " << poses.size() << " ticks unconverged, " << misplaced << " of " << compared
                   << " compared ones misplaced");
      CHECK(unconverged == 0);
      CHECK(misplaced <= 1);
    }
  }
}
