#include "core/lab/measure/distribution.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("percentiles are values that occurred, by nearest rank") {
  std::vector<double> values;
  for (int i = 1000; i >= 1; --i) values.push_back(i);
  const Distribution d = distribution(values);
  CHECK(d.count == 1000);
  CHECK(d.mean == approx(500.5));
  CHECK(d.p50 == 500.0);
  CHECK(d.p99 == 990.0);
  CHECK(d.p999 == 999.0);
  CHECK(d.max == 1000.0);
}

TEST_CASE("one value is all its percentiles, no values are all zero") {
  const Distribution one = distribution({7.0});
  CHECK(one.mean == 7.0);
  CHECK(one.p50 == 7.0);
  CHECK(one.p999 == 7.0);
  const Distribution none = distribution({});
  CHECK(none.count == 0);
  CHECK(none.max == 0.0);
}

TEST_CASE("the middle mean leaves out the lowest and the highest quarter") {
  CHECK(middle_mean({}) == 0.0);
  CHECK(middle_mean({3.0}) == 3.0);
  CHECK(middle_mean({1.0, 2.0, 4.0}) == approx(7.0 / 3.0));
  CHECK(middle_mean({1e9, 5.0, 4.0, -1e9}) == 4.5);
  // A clock that reads 30 or 40 and stands at 37 on average.
  std::vector<double> steps(1000, 40.0);
  for (int i = 0; i < 300; ++i) steps[static_cast<std::size_t>(i)] = 30.0;
  for (int i = 0; i < 30; ++i) steps[static_cast<std::size_t>(999 - i)] = 1e6;
  CHECK(middle_mean(steps) == approx(39.0));
}
