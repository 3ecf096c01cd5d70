#include "workbench/sweep/paired_times.h"

#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

namespace tangent::sweep {

using test::approx;
namespace {

/// A machine as it is: a drift that goes on within a round, noise of 3 %, and now and then a run that something else
/// took time from.
class NoisyMachine {
 public:
  explicit NoisyMachine(unsigned seed) : random_(seed) {}
  double run(double ns) {
    drift_ *= 1.004;
    const double spike = unit() < 0.05 ? 1.0 + unit() : 1.0;
    return ns * drift_ * spike * std::exp(0.03 * normal_(random_));
  }
  std::vector<TimeRound> rounds(double a, double b, std::size_t count) {
    std::vector<TimeRound> out;
    for (std::size_t i = 0; i < count; ++i) {
      TimeRound& round = out.emplace_back();
      for (const std::size_t k : {0u, 1u, 2u, 3u}) round[k] = run(k == 0 || k == 3 ? a : b);
    }
    return out;
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  double drift_ = 1.0;
};

TEST_CASE("two equal presets are called different in at most 5 % of 1000 trials") {
  int different = 0;
  for (unsigned seed = 0; seed < 1000; ++seed)
    different += judge(NoisyMachine(seed).rounds(200.0, 200.0, 8)).verdict != TimeVerdict::tie;
  MESSAGE("called different: ", different, " of 1000");
  CHECK(different <= 50);
}

TEST_CASE("a difference that is there is found, and a near-tie is called a tie") {
  int faster = 0, slower = 0, near = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    faster += judge(NoisyMachine(seed).rounds(140.0, 200.0, 12)).verdict == TimeVerdict::faster;
    slower += judge(NoisyMachine(seed).rounds(280.0, 200.0, 12)).verdict == TimeVerdict::slower;
  }
  CHECK(faster >= 190);
  CHECK(slower >= 190);
  for (int i = 0; i < 20; ++i) {  // sure, but not worth a word: half a percent without any noise
    const std::vector<TimeRound> rounds(10, TimeRound{201.0 + 1e-6 * i, 200.0, 200.0, 201.0});
    near += judge(rounds).verdict == TimeVerdict::tie;
  }
  CHECK(near == 20);
}

TEST_CASE("a drift within a round does not count for either") {
  std::vector<TimeRound> rounds;
  for (int i = 0; i < 6; ++i) rounds.push_back({100.0, 110.0, 121.0, 133.1});
  const PairedTime time = judge(rounds);
  CHECK(time.ratio == approx(1.0));
  CHECK(time.verdict == TimeVerdict::tie);
}

TEST_CASE("a clock that leaps while one side runs makes no difference sure") {
  for (const double leap : {1e6, 1e-6}) {
    for (std::size_t side = 0; side < 4; ++side) {
      auto rounds = NoisyMachine(11).rounds(200.0, 200.0, 8);
      rounds[3][side] *= leap;  // a machine that slept for hours, or a counter that was set back
      const PairedTime time = judge(rounds);
      CHECK(time.verdict == TimeVerdict::tie);
      CHECK(time.ns == approx(200.0).epsilon(0.3));
    }
  }
}

TEST_CASE("mean and 99th percentile of ticks are timed in turns") {
  auto mesh = ContactMesh::build(*generate_mesh("icosphere"), {});
  const auto scene = *ContactScene::build(std::move(*mesh));
  std::vector<TickInput> motion;
  for (int i = 0; i < 200; ++i) motion.push_back({1e-3 * i, {Vec3(1e-5 * i, 0.0, 0.059), {}}});
  const auto times = time_paired_ticks(scene, Preset{}, Preset{}, motion, 3);
  REQUIRE(times);
  CHECK(times->p99.rounds == 3);
  CHECK(times->p99.ns > 0.0);
  CHECK(times->mean.rounds == 3);
  CHECK(!time_paired_ticks(scene, Preset{}, Preset{}, motion, 3, [] { return true; }));
}

TEST_CASE("presets are timed in turns, and stopping ends it") {
  auto mesh = ContactMesh::build(*generate_mesh("icosphere"), {});
  const auto scene = *ContactScene::build(std::move(*mesh));
  std::vector<TickInput> motion;
  for (int i = 0; i < 50; ++i) motion.push_back({1e-3 * i, {Vec3(1e-5 * i, 0.0, 0.059), {}}});
  const auto time = time_paired(scene, Preset{}, Preset{}, motion, 3);
  REQUIRE(time);
  CHECK(time->rounds == 3);
  CHECK(time->ns > 0.0);
  CHECK(time->low <= time->ratio);
  CHECK(time->ratio <= time->high);
  CHECK(!time_paired(scene, Preset{}, Preset{}, motion, 3, [] { return true; }));
}

}  // namespace
}  // namespace tangent::sweep
