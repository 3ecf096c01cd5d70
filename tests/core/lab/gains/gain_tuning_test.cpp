#include "core/lab/gains/gain_tuning.h"

#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <cmath>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A finger of 20 mm that slides over a sphere of 40 mm, 1 mm deep, 0.1 m/s.
std::vector<TickInput> slide(int count) {
  std::vector<TickInput> poses;
  const double distance = 0.059;
  for (int i = 0; i < count; ++i) {
    const double a = 1e-4 / distance * i;
    const Vec3 direction(std::cos(a), std::sin(a) * std::cos(0.4), std::sin(a) * std::sin(0.4));
    poses.push_back(at_position(1e-3 * i, distance * direction));
  }
  return poses;
}

ScenePtr coarse_sphere() { return scene_of(make_icosphere(0.040, 2)); }

GainGrid small_grid() {
  GainGrid grid = make_gain_grid(0.020);
  grid.coarse.clear();
  for (const double overall : {0.8, 1.0, 1.2})
    for (const double curvature : {0.0, 0.01, 0.02, 0.04}) grid.coarse.push_back({overall, curvature, 0.0});
  return grid;
}

}  // namespace

TEST_CASE("unconverged ticks count first, then the mean, then the 99th percentile") {
  RunScore a, b;
  a.ticks = b.ticks = 10;
  a.unconverged = 0, a.iterations = 90, b.unconverged = 1, b.iterations = 10;
  CHECK(better(a, b));
  CHECK_FALSE(better(b, a));
  b.unconverged = 0;
  CHECK(better(b, a));
  b.iterations = 90;
  CHECK_FALSE(better(a, b));
  CHECK_FALSE(better(b, a));
  b.p99_iterations = 1;
  CHECK(better(a, b));
}

TEST_CASE("a score is what the ticks add up to") {
  const ScenePtr scene = coarse_sphere();
  const std::vector<TickInput> poses = slide(500);
  const Preset preset = sphere_preset(0.020, Method::paper);
  Stepper stepper(scene);
  const RunScore score = score_run(stepper, preset, poses);
  TickState state;
  std::uint64_t sum = 0;
  double error = 0.0;
  std::vector<int> iterations;
  for (const TickInput& input : poses) {
    const TickOutput out = stepper.step(preset, input, state);
    REQUIRE(out.status != TickStatus::unconverged);
    sum += static_cast<std::uint64_t>(out.iterations);
    error = std::max(error, out.error_m);
    iterations.push_back(out.iterations);
  }
  std::sort(iterations.begin(), iterations.end());
  CHECK(score.ticks == 500);
  CHECK(score.unconverged == 0);
  CHECK(score.iterations == sum);
  CHECK(score.mean_iterations() == approx(static_cast<double>(sum) / 500.0).epsilon(1e-15));
  CHECK(score.p99_iterations == iterations[494]);
  CHECK(score.max_iterations == iterations.back());
  CHECK(score.max_error_m == error);
}

TEST_CASE("tuned gains beat the untuned ones by far, and every tick converges") {
  const std::vector<TickInput> poses = slide(rounds(2000));
  const GainTuning tuning =
      tune_gains(coarse_sphere(), sphere_preset(0.020, Method::paper), poses, make_gain_grid(0.020));
  REQUIRE_FALSE(tuning.best.empty());
  CHECK_FALSE(tuning.stopped);
  CHECK(tuning.untuned.gains == Gains{1.0, 0.0, 0.0});
  CHECK(tuning.untuned.score.ticks == poses.size());
  const RunScore& best = tuning.best.front().score;
  MESSAGE("untuned " << tuning.untuned.score.mean_iterations() << ", tuned " << best.mean_iterations());
  CHECK(best.unconverged == 0);
  CHECK(best.max_error_m < 1e-6);
  CHECK(tuning.untuned.score.mean_iterations() > 5.0);
  CHECK(best.mean_iterations() < 1.5);
}

TEST_CASE("ending bad runs early changes nothing: the best are those of all the grid, in order") {
  const ScenePtr scene = coarse_sphere();
  const std::vector<TickInput> poses = slide(1500);
  const Preset base = sphere_preset(0.020, Method::paper);
  const GainGrid grid = small_grid();
  // The walk is stopped at once: only the grid is tried.
  const GainTuning tuning =
      tune_gains(scene, base, poses, grid, [&](std::size_t done, std::size_t) { return done < grid.coarse.size(); });
  CHECK(tuning.stopped);
  CHECK(tuning.tried == grid.coarse.size());
  std::vector<GainTrial> all;
  Stepper stepper(scene);
  for (const Gains& gains : grid.coarse) {
    Preset preset = base;
    preset.solver = with_gains(preset.solver, gains);
    all.push_back({gains, score_run(stepper, preset, poses)});
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return better(a.score, b.score); });
  REQUIRE(tuning.best.size() == kBestTrials);
  for (std::size_t i = 0; i < kBestTrials; ++i) {
    CAPTURE(i);
    CHECK(tuning.best[i].score.iterations == all[i].score.iterations);
    CHECK(tuning.best[i].score.p99_iterations == all[i].score.p99_iterations);
  }
  CHECK(tuning.best.front().gains == all.front().gains);
}

TEST_CASE("the walk ends where no neighbour is better") {
  const ScenePtr scene = coarse_sphere();
  const std::vector<TickInput> poses = slide(1000);
  const Preset base = sphere_preset(0.020, Method::paper);
  const GainGrid grid = small_grid();
  const GainTuning tuning = tune_gains(scene, base, poses, grid);
  const GainTrial& best = tuning.best.front();
  Stepper stepper(scene);
  for (const Gains& step :
       {Gains{grid.fine.overall, 0, 0}, Gains{0, grid.fine.curvature_m, 0}, Gains{0, 0, grid.fine.distance_per_m}}) {
    for (const double sign : {-1.0, 1.0}) {
      const Gains at{best.gains.overall + sign * step.overall, best.gains.curvature_m + sign * step.curvature_m,
                     best.gains.distance_per_m + sign * step.distance_per_m};
      if (at.distance_per_m < 0.0) continue;
      Preset preset = base;
      preset.solver = with_gains(preset.solver, at);
      CHECK_FALSE(better(score_run(stepper, preset, poses), best.score));
    }
  }
}

TEST_CASE("the same arguments give the same gains, whatever the base's method") {
  const std::vector<TickInput> poses = slide(400);
  const GainTuning a = tune_gains(coarse_sphere(), sphere_preset(0.020, Method::paper), poses, small_grid());
  const GainTuning b = tune_gains(coarse_sphere(), sphere_preset(0.020, Method::robust), poses, small_grid());
  REQUIRE(a.best.size() == b.best.size());
  CHECK(a.tried == b.tried);
  for (std::size_t i = 0; i < a.best.size(); ++i) CHECK(a.best[i].gains == b.best[i].gains);
}

TEST_CASE("a tuning that is stopped keeps the complete runs, and none where there was none") {
  const std::vector<TickInput> poses = slide(1000);
  const Preset base = sphere_preset(0.020, Method::paper);
  const GainTuning none =
      tune_gains(coarse_sphere(), base, poses, small_grid(), [](std::size_t, std::size_t) { return false; });
  CHECK(none.stopped);
  CHECK(none.best.empty());
  CHECK(none.untuned.score.ticks == 0);
  const GainTuning three =
      tune_gains(coarse_sphere(), base, poses, small_grid(), [](std::size_t done, std::size_t) { return done < 3; });
  CHECK(three.stopped);
  CHECK(three.tried == 3);
  CHECK(three.best.size() == 3);
  for (const GainTrial& trial : three.best) CHECK(trial.score.ticks == poses.size());
}

TEST_CASE("gains of the grid are short decimal numbers for fingers of any size") {
  for (const double length : {0.001, 0.0075, 0.008, 0.020, 0.3, 1.0}) {
    CAPTURE(length);
    const GainGrid grid = make_gain_grid(length);
    CHECK(grid.fine.curvature_m <= length / 200.0 * (1.0 + 1e-9));
    CHECK(grid.fine.curvature_m >= length / 500.0 * (1.0 - 1e-9));
    CHECK(std::any_of(grid.coarse.begin(), grid.coarse.end(), [&](const Gains& g) { return g.curvature_m == length; }));
    for (const double unit : {grid.fine.curvature_m, grid.fine.distance_per_m}) {
      const double digits = unit / std::pow(10.0, std::floor(std::log10(unit) + 1e-9));
      const double nearest = std::round(digits);
      CHECK(std::abs(digits - nearest) < 1e-9);
      CHECK((nearest == 1.0 || nearest == 2.0 || nearest == 5.0));
    }
  }
}
