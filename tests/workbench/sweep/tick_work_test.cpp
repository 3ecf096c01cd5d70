#include "workbench/sweep/tick_work.h"

#include "core/io/scene_file.h"
#include "core/lab/measure/distribution.h"
#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"
#include "workbench/session/exploration_poses.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace tangent::sweep {

using test::approx;
namespace {

TEST_CASE("a tick's counted time is the sum of what it did") {
  TickOutput output;
  output.iterations = 3;
  output.triangle_changes = 2;
  CHECK(counted_us(output, false) == approx(kTickUs + 3.0 * kPlaneUs + 2.0 * kCrossingUs));
  CHECK(counted_us(output, true) == approx(counted_us(output, false) + kSearchUs));
  output.event = TickEvent::reseed;
  CHECK(counted_us(output, true) == approx(kTickUs + 3.0 * kPlaneUs + 2.0 * kCrossingUs + kSearchUs + kSeedUs));
}

/// Of one preset: counted, and the least of four passes.
struct Times {
  Distribution counted, measured;
};

Times times_of(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
               std::span<const TickInput> motion) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> counted, measured(motion.size(), 1e300);
  Stepper stepper(scene);
  for (int pass = 0; pass < 4; ++pass) {
    TickState state;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const Vec3 before = state.clearance.centre;
      const auto began = Clock::now();
      const TickOutput output = stepper.step(preset, motion[i], state);
      measured[i] = std::min(measured[i], std::chrono::duration<double, std::micro>(Clock::now() - began).count());
      if (pass == 0) counted.push_back(counted_us(output, before != state.clearance.centre));
    }
  }
  return {distribution(std::move(counted)), distribution(std::move(measured))};
}

double correlation(const std::vector<Times>& runs, double Distribution::*what) {
  const auto n = static_cast<double>(runs.size());
  double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (const Times& run : runs) {
    const double a = std::log(run.counted.*what), b = std::log(run.measured.*what);
    x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
  }
  return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
}

TEST_CASE("counted time stands for the time that ticks take, as the page of sweeps has it") {
  const char* const meshes = std::getenv("TANGENT_TIMES");  // "torus spot.obj": only said, never passed or failed
  if (meshes == nullptr) return;
  std::istringstream names(meshes);
  for (std::string name; names >> name;) {
    SceneOptions reading;
    reading.mesh.fit_m = 0.08;
    const bool file = name.find(".obj") != std::string::npos;
    const auto scene =
        file ? *load_scene(name, reading) : *ContactScene::build(*ContactMesh::build(*generate_mesh(name), {}));
    auto poses = exploration_poses(*scene, Finger{}, ExplorationKind::around, ExplorationPace::varied)->poses;
    poses.resize(std::min<std::size_t>(poses.size(), 4000));
    std::vector<Times> runs;
    double least = 1e300, most = 0.0;
    for (const double tolerance : {1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
      for (const double share : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        Preset preset;
        preset.solver.method = Method::paper;
        preset.solver.tolerance_m = tolerance;
        preset.solver.gain_curvature_m = share * preset.finger.reach_m();
        runs.push_back(times_of(scene, preset, poses));
        least = std::min(least, runs.back().measured.p99);
        most = std::max(most, runs.back().measured.p99);
      }
    }
    MESSAGE(name, ": correlation of the logarithms over ", runs.size(), " presets: mean ",
            correlation(runs, &Distribution::mean), ", p99 ", correlation(runs, &Distribution::p99), " (of ", least,
            " to ", most, " us)");
  }
}

}  // namespace
}  // namespace tangent::sweep
