#include "workbench/analysis/group_tests.h"

#include "workbench/analysis/studentized_range.h"
#include "workbench/experiment/paper_results.h"

#include "core/base/split_mix.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <array>
#include <cmath>

namespace tangent::analysis {

using test::approx;
namespace {

double normal_value(SplitMix& random) {
  return boost::math::quantile(boost::math::normal(), std::max(1e-15, random.unit()));
}

TEST_CASE("the studentized range has the upper points of the published tables") {
  // Upper 5 and 1 % points (Pearson & Hartley, Biometrika Tables for Statisticians I, table 29).
  struct Point {
    double above;
    int groups;
    double freedom, q;
  };
  constexpr std::array<Point, 15> kPoints{{{0.05, 2, 5, 3.64},
                                           {0.05, 3, 5, 4.60},
                                           {0.05, 4, 5, 5.22},
                                           {0.05, 2, 10, 3.15},
                                           {0.05, 3, 10, 3.88},
                                           {0.05, 5, 10, 4.65},
                                           {0.05, 3, 20, 3.58},
                                           {0.05, 4, 20, 3.96},
                                           {0.05, 5, 20, 4.23},
                                           {0.05, 10, 20, 5.01},
                                           {0.05, 4, 40, 3.79},
                                           {0.05, 4, 60, 3.74},
                                           {0.01, 2, 5, 5.70},
                                           {0.01, 3, 10, 5.27},
                                           {0.01, 4, 20, 5.02}}};
  for (const Point& point : kPoints) {
    CAPTURE(point.groups);
    CAPTURE(point.freedom);
    CHECK(std::abs(studentized_range_quantile(point.above, point.groups, point.freedom) - point.q) < 0.0051);
    CHECK(studentized_range_above(point.q, point.groups, point.freedom) == approx(point.above).epsilon(0.02));
  }
}

TEST_CASE("the range of two means is Student's t times the square root of two") {
  for (const double freedom : {1.0, 2.0, 5.0, 44.0, 1000.0}) {
    const boost::math::students_t t(freedom);
    for (const double q : {0.3, 1.0, 2.5, 4.0, 8.0}) {
      const double exact = 2.0 * boost::math::cdf(boost::math::complement(t, q / std::sqrt(2.0)));
      CAPTURE(freedom);
      CAPTURE(q);
      CHECK(std::abs(studentized_range_above(q, 2, freedom) - exact) < 1e-7);
    }
  }
}

TEST_CASE("t tests of Student's own data") {
  // Extra hours of sleep under two drugs (Student 1908); the values as R's t.test prints them.
  const std::vector<double> a{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
  const std::vector<double> b{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  const auto paired = paired_t_test(a, b);
  REQUIRE(paired);
  CHECK(paired->t == approx(-4.0621).epsilon(1e-4));
  CHECK(paired->freedom == 9.0);
  CHECK(paired->p == approx(0.002833).epsilon(1e-3));
  CHECK(paired->low == approx(-2.4598858).epsilon(1e-6));
  CHECK(paired->high == approx(-0.7001142).epsilon(1e-6));
  const auto welch = welch_t_test(a, b);
  REQUIRE(welch);
  CHECK(welch->t == approx(-1.8608).epsilon(1e-4));
  CHECK(welch->freedom == approx(17.776).epsilon(1e-4));
  CHECK(welch->p == approx(0.07939).epsilon(1e-3));
  const auto student = student_t_test(a, b);
  REQUIRE(student);
  CHECK(student->freedom == 18.0);
  CHECK(student->p == approx(0.07919).epsilon(1e-3));
}

TEST_CASE("what can't be tested has no test") {
  const std::vector<double> one{1.0}, same{2.0, 2.0, 2.0}, some{1.0, 2.0, 4.0};
  CHECK_FALSE(student_t_test(one, some));
  CHECK_FALSE(welch_t_test(same, same));
  CHECK_FALSE(paired_t_test(some, some));
  CHECK_FALSE(one_way_anova(std::vector<std::vector<double>>{some}));
  CHECK_FALSE(one_way_anova(std::vector<std::vector<double>>{one, one}));
  CHECK_FALSE(one_way_anova(std::vector<std::vector<double>>{some, {}}));
}

TEST_CASE("analysis of variance of a textbook's three groups") {
  const std::vector<std::vector<double>> groups{{6, 8, 4, 5, 3, 4}, {8, 12, 9, 11, 6, 8}, {13, 9, 11, 8, 7, 12}};
  const auto anova = one_way_anova(groups);
  REQUIRE(anova);
  CHECK(anova->f == approx(42.0 / (68.0 / 15.0)));
  CHECK(anova->freedom_between == 2.0);
  CHECK(anova->freedom_error == 15.0);
  CHECK(anova->p == approx(0.002399).epsilon(1e-3));
  const std::vector<TukeyPair> pairs = tukey_test(groups, *anova);
  REQUIRE(pairs.size() == 3);
  CHECK(pairs[0].p < 0.05);  // 5 and 9
  CHECK(pairs[1].p < 0.05);  // 5 and 10
  CHECK(pairs[2].p > 0.05);  // 9 and 10
  for (const TukeyPair& pair : pairs) CHECK((pair.p < 0.05) == (pair.low * pair.high > 0.0));
}

TEST_CASE("the paper's Table 1 gives the paper's F") {
  // Twelve values with a mean and a deviation: half lie one deviation above, half below, stretched to the sample's.
  std::vector<std::vector<double>> groups;
  const double n = experiment::kPaperDiscriminationParticipants;
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  for (const experiment::PaperThreshold& row : experiment::kPaperThresholds) {
    const double deviation = row.half_interval * std::sqrt(n) / t * std::sqrt((n - 1.0) / n);
    auto& group = groups.emplace_back();
    for (int i = 0; i < 12; ++i) group.push_back(row.segments + (i % 2 == 0 ? deviation : -deviation));
  }
  const auto anova = one_way_anova(groups);
  REQUIRE(anova);
  CHECK(anova->f == approx(experiment::kPaperAnovaF).epsilon(0.005));
  const auto pairs = tukey_test(groups, *anova);
  for (std::size_t i = 0; i < 6; ++i) CHECK((pairs[i].p < 0.05) == (i != 4));  // all but C2 and C4, 5.2.6
}

TEST_CASE("of two groups both analyses are t tests") {
  const std::vector<std::vector<double>> groups{{0.7, -1.6, -0.2, -1.2, -0.1, 3.4}, {1.9, 0.8, 1.1, 0.1, -0.1, 4.4}};
  const auto t = student_t_test(groups[0], groups[1]);
  const auto paired = paired_t_test(groups[0], groups[1]);
  const auto anova = one_way_anova(groups);
  const auto repeated = repeated_measures_anova(groups);
  REQUIRE(anova);
  REQUIRE(repeated);
  CHECK(anova->f == approx(t->t * t->t));
  CHECK(anova->p == approx(t->p));
  CHECK(repeated->f == approx(paired->t * paired->t));
  CHECK(repeated->p == approx(paired->p));
  CHECK(tukey_test(groups, *anova)[0].p == approx(t->p).epsilon(1e-6));
}

TEST_CASE("repeated measures see a difference that participants hide") {
  std::vector<std::vector<double>> groups(3);
  SplitMix random(5);
  for (int i = 0; i < 8; ++i) {
    const double own = 100.0 * normal_value(random);
    for (std::size_t g = 0; g < 3; ++g) groups[g].push_back(own + 3.0 * static_cast<double>(g) + normal_value(random));
  }
  CHECK(one_way_anova(groups)->p > 0.5);
  CHECK(repeated_measures_anova(groups)->p < 1e-4);
}

TEST_CASE("groups that are equal differ in five of a hundred, by the analysis and by any of Tukey's pairs") {
  SplitMix random(11);
  int anova_differs = 0, tukey_differs = 0;
  constexpr int kTrials = 2000;
  const double critical = studentized_range_quantile(0.05, 4, 44.0);
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<std::vector<double>> groups(4);
    for (auto& group : groups)
      for (int i = 0; i < 12; ++i) group.push_back(normal_value(random));
    const auto anova = one_way_anova(groups);
    anova_differs += anova->p < 0.05;
    double low = 1e9, high = -1e9;
    for (const auto& group : groups) {
      double mean = 0.0;
      for (const double v : group) mean += v / 12.0;
      low = std::min(low, mean);
      high = std::max(high, mean);
    }
    tukey_differs += (high - low) / std::sqrt(anova->mean_square_error / 12.0) > critical;
  }
  MESSAGE("found different: ", anova_differs, " and ", tukey_differs, " of ", kTrials);
  // 100 expected; a hundred more or fewer than 3 deviations (9.7) is a wrong test
  CHECK(std::abs(anova_differs - 100) < 30);
  CHECK(std::abs(tukey_differs - 100) < 30);
}

}  // namespace
}  // namespace tangent::analysis
