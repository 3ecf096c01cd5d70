#include "core/lab/objects/generate.h"
#include "workbench/bench/bench_case.h"
#include "workbench/bench/case_paths.h"

namespace tangent::bench {

std::vector<BenchCase> mean_cases() {
  constexpr double kRadius = 0.040, kPress = 1e-3, kSpeed = 0.1;
  std::vector<BenchCase> cases;
  for (const int subdivisions : {3, 5, 7}) {
    for (const int finger_mm : {0, 5, 20}) {
      BenchCase c;
      c.name = "ball_" + std::to_string(20u << (2 * subdivisions)) +
               (finger_mm == 0 ? std::string("_point") : "_" + std::to_string(finger_mm) + "mm");
      c.what = "radius 40 mm, 1 mm deep at 0.1 m/s";
      c.mesh = [subdivisions]() -> Result<PolygonMesh> { return make_icosphere(kRadius, subdivisions); };
      c.preset.finger.radius_m = 1e-3 * finger_mm;
      if (finger_mm == 0) c.preset.finger.shape = FingerShape::point;
      c.poses = [](const ContactScene& scene, const Finger& finger, int ticks) {
        return around_ball(scene.mesh().origin(), kRadius + finger.reach_m() - kPress, kSpeed, ticks);
      };
      cases.push_back(std::move(c));
    }
  }
  return cases;
}

}  // namespace tangent::bench
