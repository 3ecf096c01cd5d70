// The paper says that its iteration takes two to three planes on average on its objects (4.5.3): how many it takes in
// the strokes of its participants, and what depth and speed change in that.
#include "core/tick/step.h"
#include "tests/support/approx.h"
#include "workbench/bench/bench_case.h"
#include "workbench/bench/case_paths.h"
#include "workbench/session/stroke_path.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::bench;

namespace {

/// The finger lies on top: its contact's normal is within 45 degrees of up.
bool on_top(const TickOutput& out) { return out.normal.z > std::numbers::sqrt2 / 2.0; }

struct Planes {
  double all = 0.0, top = 0.0;  ///< mean of a tick, and of those on top
  int unconverged = 0;
};

/// `paper` with the case's own gains, along all strokes of an object once.
Planes of_object(const Preset& preset, const ScenePtr& scene, const StrokePath& path, double speed, double press) {
  Stepper stepper(scene);
  TickState state;
  const double way = speed * kTickSeconds, pad = pad_distance_m(preset.finger);
  const int ticks = static_cast<int>(path.length_m() / way);
  Planes out;
  int top = 0;
  for (int i = 0; i < ticks; ++i) {
    const PathPose pose = path.at(way * i, pad, press);
    TickInput input;
    input.t_s = kTickSeconds * i;
    input.finger.position = pose.position_m;
    input.finger.orientation = pose.orientation;
    const TickOutput tick = stepper.step(preset, input, state);
    out.all += tick.iterations;
    if (on_top(tick)) ++top, out.top += tick.iterations;
    out.unconverged += tick.status == TickStatus::unconverged;
  }
  out.all /= ticks;
  out.top /= top;
  return out;
}

/// The mean of the seven objects at each pair of a depth and a speed.
class SevenObjects {
 public:
  SevenObjects() {
    for (BenchCase& c : stroke_cases()) {
      c.preset.solver.method = Method::paper;
      Result<ScenePtr> scene = build_scene(c);
      REQUIRE(scene);
      Result<StrokePath> path = StrokePath::build(**scene, pad_distance_m(c.preset.finger));
      REQUIRE(path);
      objects_.push_back({c.preset, *scene, *path});
    }
    REQUIRE(objects_.size() == 7);
  }
  Planes planes(double speed, double press) const {
    Planes out;
    for (const Object& object : objects_) {
      const Planes one = of_object(object.preset, object.scene, object.path, speed, press);
      out.all += one.all / static_cast<double>(objects_.size());
      out.top += one.top / static_cast<double>(objects_.size());
      out.unconverged += one.unconverged;
    }
    return out;
  }

 private:
  struct Object {
    Preset preset;
    ScenePtr scene;
    StrokePath path;
  };
  std::vector<Object> objects_;
};

}  // namespace

TEST_CASE(
    "in the paper's strokes its iteration takes two to three planes, and slower, faster or deeper converges, too") {
  const SevenObjects objects;
  const Planes shipped = objects.planes(0.1, 1.0e-3);
  MESSAGE("0.1 m/s, 1 mm deep: " << shipped.all << " planes, on top " << shipped.top);
  CHECK(shipped.all == approx(2.58).epsilon(0.003));
  CHECK(shipped.unconverged == 0);
  for (const auto& [speed, press] : {std::pair(0.05, 0.5e-3), {0.25, 2.0e-3}}) {
    CAPTURE(speed);
    const Planes other = objects.planes(speed, press);
    CHECK(other.all > 2.0);
    CHECK(other.all < 3.2);
    CHECK(other.unconverged == 0);
  }
}

TEST_CASE("measure: planes in the paper's strokes, by depth and speed" * doctest::skip()) {
  const SevenObjects objects;
  std::printf("planes a tick, mean of seven objects (on top; ticks that did not converge)\n%8s", "mm");
  for (const double speed : {0.05, 0.10, 0.15, 0.20, 0.25}) std::printf("  %10.2f m/s     ", speed);
  std::printf("\n");
  for (const double press : {0.2e-3, 0.4e-3, 0.6e-3, 0.8e-3, 1.0e-3, 1.5e-3, 2.0e-3, 3.0e-3}) {
    std::printf("%8.1f", 1e3 * press);
    for (const double speed : {0.05, 0.10, 0.15, 0.20, 0.25}) {
      const Planes p = objects.planes(speed, press);
      std::printf("  %5.2f (%5.2f; %4d)", p.all, p.top, p.unconverged);
    }
    std::printf("\n");
  }
}
