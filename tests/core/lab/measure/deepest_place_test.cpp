// Whether the tracked contact is the deepest one: a search from nothing at the same pose must not find a deeper place.
#include "core/base/tolerances.h"
#include "tests/core/scenes.h"

#include <fstream>
#include <sstream>

using namespace tangent;
using namespace tangent::test;

namespace {

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
    for (const double crease_deg : {45.0, 180.0}) {
      const ScenePtr scene = shared_scene(name + ".obj", crease_deg);
      if (!scene) return;
      for (const auto& [file, radius] : {std::pair(name + "-r005.csv", 0.005), {name + "-r020.csv", 0.020}}) {
        CAPTURE(crease_deg);
        const Preset preset = sphere_preset(radius, Method::robust);
        std::vector<TickInput> poses = shared_poses(file);
        REQUIRE(poses.size() == 20000);
        poses.resize(static_cast<std::size_t>(rounds(20000)));
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
          const double behind = cold.penetration_m - tracked.penetration_m - preset.solver.switch_hysteresis_m -
                                preset.solver.tolerance_m;
          late += behind > 0.0;
          shallower += behind > 2.0 * kHeightGuess * radius;
        }
        MESSAGE(file << ", creases " << crease_deg << ": " << unconverged << " of " << poses.size()
                     << " ticks unconverged, " << late << " behind a deeper place, " << shallower
                     << " by more than heights are guessed to");
        CHECK(unconverged == 0);
        CHECK(shallower == 0);
      }
    }
  }
}
