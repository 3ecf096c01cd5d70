// What the ticks of an ellipsoid and a capsule cost over a sphere's: in time, and the ways for callgrind, which counts
// instructions (workbench/bench/README.md, "Means and tails").
#include "core/io/mesh_io.h"
#include "tests/core/fingers.h"
#include "tests/core/random_bodies.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <sstream>

using namespace tangent;
using namespace tangent::test;

namespace {

struct CostBody {
  std::string name;
  ScenePtr scene;
};

ScenePtr generated(const std::string& name, double rounding_m, int segments = 0) {
  GenerateOptions options;
  options.rounding_m = rounding_m;
  options.segments = segments;
  const auto mesh = generate_mesh(name, options);
  REQUIRE(mesh);
  return scene_of(*mesh);
}

ScenePtr made_at_random(int number) {
  Random random{98};
  PolygonMesh mesh = random_blob(random);
  while (--number > 0) mesh = random_blob(random);
  return scene_of(mesh);
}

bool is_wanted(const char* variable, const std::string& name) {
  const char* wanted = std::getenv(variable);
  return !wanted || name == wanted;
}

/// Of all bodies that one that TANGENT_BODY names, or all of them.
std::vector<CostBody> wanted_bodies() {
  std::vector<CostBody> bodies;
  const auto add = [&](const std::string& name, auto make) {
    if (is_wanted("TANGENT_BODY", name)) bodies.push_back({name, make()});
  };
  add("spot", [] { return spot_scene(45.0); });
  for (const std::string name : {"stanford-bunny", "fandisk"})
    if (testing::shared_files_there({("meshes/" + name + ".obj").c_str()}))
      add(name, [&] { return file_scene(testing::shared_file("meshes/" + name + ".obj"), 45.0); });
  add("icosphere", [] { return generated("icosphere", 0.0, 5); });
  for (const std::string name : {"cube", "cylinder", "cone", "octagon", "tetrahedron"})
    add(name, [&] { return generated(name, 1.5e-3); });
  add("torus", [] { return generated("torus", 0.0); });
  for (int i = 1; i <= 4; ++i) add("random-" + std::to_string(i), [i] { return made_at_random(i); });
  for (const std::string name : {"cube", "cylinder"}) add("sharp-" + name, [&] { return generated(name, 0.0); });
  return bodies;
}

/// Round the raw mesh, the centre 4.5 mm off, at 0.1 m/s, and turning by 0.17 degrees a tick.
std::vector<TickInput> way_round(const ContactScene& scene, int ticks) {
  constexpr double kOff = 4.5e-3, kStep = 1e-4, kTurn = 0.003;
  const Vec3 origin = scene.mesh().origin();
  Random random{99};
  Vec3 centre = scene.mesh().bounds().centre() + glm::length(scene.mesh().bounds().size()) * random.direction();
  Vec3 heading = random.direction();
  Quat orientation = random.orientation();
  std::vector<TickInput> way;
  for (int i = 0; i < ticks; ++i) {
    const Vec3 point = scene.nearest().nearest(centre, std::numeric_limits<double>::infinity()).point;
    const Vec3 out = unit(centre - point);
    centre = point + kOff * out;
    orientation = glm::normalize(glm::angleAxis(kTurn, heading) * orientation);
    way.push_back({1e-3 * i, {origin + centre, orientation}});
    if (i % 300 == 299) heading = random.direction();
    heading = unit(heading - glm::dot(heading, out) * out);
    centre += kStep * heading;
  }
  return way;
}

Preset cost_preset(FingerShape shape) {
  Preset preset = sphere_preset(shape == FingerShape::capsule ? 0.004 : 0.005, Method::robust);
  preset.finger.shape = shape;
  preset.finger.semi_axes_m = {0.006, 0.005, 0.004};
  preset.finger.half_length_m = 0.002;
  return preset;
}

struct WayCost {
  long evaluations = 0;
  int unconverged = 0, facing = 0;
  double seconds = 0.0;
};

WayCost cost_of(const ScenePtr& scene, const Preset& preset, const std::vector<TickInput>& way) {
  Stepper stepper(scene);
  TickState state;
  WayCost cost;
  const auto start = std::chrono::steady_clock::now();
  for (const TickInput& input : way) {
    const TickOutput out = stepper.step(preset, input, state);
    cost.evaluations += out.iterations;
    cost.unconverged += out.status == TickStatus::unconverged;
    cost.facing += out.status == TickStatus::facing;
  }
  cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return cost;
}

/// TANGENT_PASSES, 1 unless it says otherwise: the least of so many is told.
int wanted_passes() {
  const char* wanted = std::getenv("TANGENT_PASSES");
  return wanted ? std::max(1, std::atoi(wanted)) : 1;
}

const std::pair<std::string, FingerShape> kCostFingers[] = {
    {"sphere", FingerShape::sphere}, {"ellipsoid", FingerShape::ellipsoid}, {"capsule", FingerShape::capsule}};

}  // namespace

TEST_CASE("measure: what a tick of an ellipsoid and a capsule costs on bodies of many kinds" * doctest::skip()) {
  for (const auto& [body, scene] : wanted_bodies()) {
    const std::vector<TickInput> way = way_round(*scene, 1500);
    for (const auto& [name, shape] : kCostFingers) {
      if (!is_wanted("TANGENT_FINGER", name)) continue;
      CAPTURE(body);
      CAPTURE(name);
      const Preset preset = cost_preset(shape);
      WayCost least;
      for (int pass = 0; pass < wanted_passes(); ++pass) {
        const WayCost cost = cost_of(scene, preset, way);
        if (pass == 0 || cost.seconds < least.seconds) least = cost;
      }
      MESSAGE(body << ", " << name << ": " << way.size() << " ticks, " << least.evaluations << " evaluations, "
                   << least.facing << " ticks facing, " << 1e6 * least.seconds / static_cast<double>(way.size())
                   << " us a tick");
      CHECK(least.unconverged == 0);
    }
  }
}

namespace {

double microseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A finger put into a body and held there until its first search is through, us; the least of the passes, tick by
/// tick.
struct StartCost {
  double at_once = 1e9;       ///< the same in one tick
  std::vector<double> ticks;  ///< the first one and those in which the search went on
  double worst_after() const { return ticks.size() < 2 ? 0.0 : *std::max_element(ticks.begin() + 1, ticks.end()); }
};

StartCost start_cost(const ScenePtr& scene, const Preset& preset, const FingerPose& pose) {
  StartCost cost;
  for (int pass = 0; pass < wanted_passes(); ++pass) {
    cost.at_once = std::min(cost.at_once, microseconds([&] { solve_once(scene, preset, pose); }));
    Stepper stepper(scene);
    TickState state;
    std::size_t tick = 0;
    do {
      const TickInput input{1e-3 * static_cast<double>(tick), pose};
      const double us =
          microseconds([&] { CHECK(stepper.step(preset, input, state).status != TickStatus::unconverged); });
      if (tick == cost.ticks.size()) cost.ticks.push_back(us);
      cost.ticks[tick] = std::min(cost.ticks[tick], us);
      ++tick;
    } while (state.start == Start::searching);
  }
  return cost;
}

std::string mean_and_tail(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  std::ostringstream text;
  text << "mean " << sum / static_cast<double>(values.size()) << ", p99 " << values[values.size() - 2] << ", worst "
       << values.back();
  return text.str();
}

}  // namespace

TEST_CASE("measure: what a first tick deep in a body costs" * doctest::skip()) {
  Finger sphere, ellipsoid, capsule;
  ellipsoid.shape = FingerShape::ellipsoid;
  ellipsoid.semi_axes_m = {0.020, 0.010, 0.008};
  capsule.shape = FingerShape::capsule;
  capsule.radius_m = 0.008;
  const std::pair<std::string, Finger> fingers[] = {{"sphere", sphere}, {"ellipsoid", ellipsoid}, {"capsule", capsule}};
  for (const auto& [body, scene] : wanted_bodies())
    for (const auto& [name, finger] : fingers)
      for (const auto& [least_m, most_m] : {std::pair(1e-3, 5e-3), std::pair(1e-2, 2e-2)}) {
        if (!is_wanted("TANGENT_FINGER", name)) continue;
        Random random{7};
        Preset preset = sphere_preset(0.020, Method::robust);
        preset.finger = finger;
        const ContactMesh& mesh = scene->mesh();
        constexpr int kPoses = 200;
        std::vector<double> at_once, first, after, ticks;
        for (int i = 0; i < kPoses; ++i) {
          const std::uint32_t t = random.below(mesh.triangle_count());
          const auto p = mesh.positions(t);
          const auto n = mesh.normals(t);
          const Vec3 middle = mesh.origin() + (p[0] + p[1] + p[2]) / 3.0;
          const FingerPose pose =
              resting_on(finger, middle, unit(n[0] + n[1] + n[2]), random.in(least_m, most_m), random);
          const StartCost cost = start_cost(scene, preset, pose);
          at_once.push_back(cost.at_once);
          first.push_back(cost.ticks.front());
          after.push_back(cost.worst_after());
          ticks.push_back(static_cast<double>(cost.ticks.size()));
        }
        MESSAGE(body << ", " << name << ", " << 1e3 * least_m << " to " << 1e3 * most_m << " mm deep, us: first tick "
                     << mean_and_tail(first) << "; worst of the ticks that it goes on in " << mean_and_tail(after)
                     << "; ticks until it is through " << mean_and_tail(ticks) << "; in one tick "
                     << mean_and_tail(at_once));
      }
}
