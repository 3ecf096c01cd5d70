#include "workbench/sweep/cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

namespace tangent::sweep {
namespace {

Range span(const char* key, double from, double to, std::size_t count = 0) {
  Range range;
  range.key = find_preset_key(key);
  range.from = from;
  range.to = to;
  range.count = count;
  return range;
}

Plan grid_plan() {
  Plan plan;
  plan.meshes = {"a", "b"};
  plan.poses = {"around", "x", "y"};
  plan.methods = {Method::paper, Method::robust};
  plan.fingers.resize(2);
  plan.fingers[1].radius_m = 0.003;
  plan.ranges = {span("solver.gain_overall", 0.5, 1.5, 3), span("solver.max_iterations", 10, 12, 5)};
  return plan;
}

Plan sampled_plan(Sampling sampling, std::size_t samples, std::uint64_t seed = 1) {
  Plan plan = grid_plan();
  plan.sampling = sampling;
  plan.samples = samples;
  plan.seed = seed;
  plan.ranges = {span("solver.gain_overall", 0.0, 4.0), span("solver.gain_curvature_m", 0.0, 4.0)};
  return plan;
}

std::vector<std::vector<double>> drawn(const Plan& plan) {
  const Result<Cells> cells = Cells::of(plan);
  REQUIRE(cells);
  std::vector<std::vector<double>> out;
  for (std::uint64_t i = 0; i < plan.samples; ++i) out.push_back(cells->at(i).values);
  return out;
}

TEST_CASE("a grid's cells are every combination, each once, and their presets have its values") {
  const Plan plan = grid_plan();
  const Result<Cells> cells = Cells::of(plan);
  REQUIRE(cells);
  CHECK(cells->size() == 2 * 3 * 2 * 2 * 3 * 3);  // whole numbers from 10 to 12 are three
  CHECK(cells->per_group() == 2 * 3 * 3);
  std::set<std::vector<double>> seen;
  for (std::uint64_t i = 0; i < cells->size(); ++i) {
    const Cell cell = cells->at(i);
    CHECK(cell.index == i);
    std::vector<double> all = cell.values;
    for (const std::size_t part : {cell.mesh, cell.poses, cell.finger, cell.method})
      all.push_back(static_cast<double>(part));
    seen.insert(all);
    const Preset preset = cells->preset(cell);
    CHECK(preset.solver.gain_overall == cell.values[0]);
    CHECK(preset.solver.max_iterations == static_cast<int>(cell.values[1]));
    CHECK(preset.solver.method == plan.methods[cell.method]);
    CHECK(preset.finger == plan.fingers[cell.finger]);
  }
  CHECK(seen.size() == cells->size());
}

TEST_CASE("samples are the same for the same seed, others for another, and lie in their ranges") {
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube, Sampling::sobol}) {
    const auto values = drawn(sampled_plan(sampling, 100));
    CHECK(values == drawn(sampled_plan(sampling, 100)));
    CHECK(values != drawn(sampled_plan(sampling, 100, 2)));
    for (const std::vector<double>& sample : values)
      for (const double value : sample) CHECK((value >= 0.0 && value <= 4.0));
  }
}

TEST_CASE("a Latin hypercube meets every part of every range once") {
  for (std::size_t r = 0; r < 2; ++r) {
    std::set<int> parts;
    for (const auto& sample : drawn(sampled_plan(Sampling::latin_hypercube, 64)))
      parts.insert(static_cast<int>(sample[r] / 4.0 * 64.0));
    CHECK(parts.size() == 64);
  }
}

/// The largest deviation of a cell's count from an even spread, of 4 x 4 cells.
int unevenness(Sampling sampling, std::uint64_t seed) {
  std::array<int, 16> counts{};
  for (const auto& sample : drawn(sampled_plan(sampling, 256, seed)))
    ++counts[static_cast<std::size_t>(std::min(3.0, sample[0])) * 4 +
             static_cast<std::size_t>(std::min(3.0, sample[1]))];
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  return std::max(*most - 16, 16 - *least);
}

TEST_CASE("Sobol's sequence fills a square evenly, moved by a seed or not") {
  CHECK(unevenness(Sampling::sobol, 0) <= 1);
  CHECK(unevenness(Sampling::sobol, 7) <= 4);
  CHECK(unevenness(Sampling::random, 7) > 4);
}

TEST_CASE("a plan of more cells than can be numbered is refused") {
  Plan plan = grid_plan();
  plan.ranges = {span("solver.gain_overall", 0.5, 1.5, 1'000'000), span("solver.gain_curvature_m", 0.5, 1.5, 1'000'000),
                 span("solver.tolerance_m", 1e-9, 1e-3, 1000)};
  CHECK(!Cells::of(plan));
}

}  // namespace
}  // namespace tangent::sweep
