#include "workbench/sweep/front_refine.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace tangent::sweep {
namespace {

/// Four trials: three on the front, with a small gap and a large one, and one behind it.
TriedPoints three_on_a_front() {
  TriedPoints tried;
  tried.shares = {{0.1, 0.1}, {0.2, 0.1}, {0.9, 0.9}, {0.5, 0.5}};
  for (const auto& objectives : std::vector<std::vector<double>>{{1.0, 10.0}, {1.5, 9.5}, {9.0, 1.0}, {9.5, 9.9}}) {
    Trial& trial = tried.trials.emplace_back();
    trial.objectives = objectives;
  }
  return tried;
}

TEST_CASE("the ends of every range are probed from both ends of the front") {
  const auto probes = end_probes(three_on_a_front(), 100);
  using Points = std::vector<std::vector<double>>;
  CHECK(probes == Points{{0, 0.1}, {0, 0.9}, {1, 0.1}, {1, 0.9}, {0.1, 0}, {0.9, 0}, {0.1, 1}, {0.9, 1}});
  CHECK(end_probes(three_on_a_front(), 3) == Points(probes.begin(), probes.begin() + 3));
}

TEST_CASE("points in gaps stay in the ranges, are the same for the same seed, and lie most about the largest gap") {
  const TriedPoints tried = three_on_a_front();
  SplitMix one(7), again(7);
  const auto points = points_in_gaps(tried, 2000, one);
  CHECK(points == points_in_gaps(tried, 2000, again));
  REQUIRE(points.size() == 2000);
  int between = 0;
  for (const auto& point : points) {
    REQUIRE(point.size() == 2);
    for (const double share : point) REQUIRE((share >= 0.0 && share <= 1.0));
    between += point[0] > 0.3 && point[0] < 0.8 && point[1] > 0.2 && point[1] < 0.8;
  }
  CHECK(between > 300);  // evenly about the trials, without what is between them, it were a handful
  CHECK(between < 1700);
}

TEST_CASE("some points go on along the line on which a front lies") {
  TriedPoints tried = three_on_a_front();
  tried.shares = {{0.2, 0.2}, {0.3, 0.3}, {0.6, 0.6}, {0.5, 0.1}};
  SplitMix random(3);
  const auto points = points_in_gaps(tried, 2000, random);
  const auto beyond = std::count_if(points.begin(), points.end(), [](const auto& p) {
    return p[0] > 0.65 && p[0] < 1.0 && std::abs(p[0] - p[1]) < 0.02;
  });
  CHECK(beyond > 50);
}

TEST_CASE("a front of one point is searched about it, and of points that miss a constraint about the nearest") {
  TriedPoints tried = three_on_a_front();
  for (std::size_t i = 0; i < tried.trials.size(); ++i) tried.trials[i].missed = i == 2 ? 0.5 : 1.0;
  SplitMix random(1);
  const auto points = points_in_gaps(tried, 500, random);
  const auto near = std::count_if(points.begin(), points.end(), [](const auto& p) { return p[0] > 0.5 && p[1] > 0.5; });
  CHECK(near > 400);
}

}  // namespace
}  // namespace tangent::sweep
