#include "devices/base/log_histogram.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace tangent;

TEST_CASE("every value lies in a bin that ends at most 1/16 above it") {
  std::vector<std::uint64_t> values{0, 1, 15, 16, 17, 31, 32, 33, 1000, std::numeric_limits<std::uint64_t>::max()};
  for (int bit = 0; bit < 64; ++bit)
    for (const std::uint64_t off : {-1, 0, 1}) values.push_back((std::uint64_t{1} << bit) + off);
  for (const std::uint64_t v : values) {
    CAPTURE(v);
    const std::size_t bin = LogHistogram::bin_of(v);
    REQUIRE(bin < LogHistogram::kBins);
    CHECK(LogHistogram::top_of(bin) >= v);
    CHECK(LogHistogram::top_of(bin) - v <= v / 16);
    if (bin > 0) CHECK(LogHistogram::top_of(bin - 1) < v);
  }
}

TEST_CASE("percentiles agree with sorted values to 1/32") {
  LogHistogram histogram;
  CHECK(histogram.percentile(0.5) == 0.0);
  std::mt19937_64 random(3);
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) {
    const double v = std::floor(std::exp(5.0 + 8.0 * static_cast<double>(random() >> 11) * 0x1p-53));
    values.push_back(v);
    histogram.add(static_cast<std::uint64_t>(v));
  }
  std::sort(values.begin(), values.end());
  CHECK(histogram.count() == values.size());
  for (const double share : {0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double exact = values[static_cast<std::size_t>(std::ceil(share * 20'000)) - 1];
    CHECK(std::abs(histogram.percentile(share) - exact) <= exact / 32.0);
  }
  CHECK(histogram.percentile(0.0) >= values.front());
  CHECK(histogram.percentile(1.0) == values.back());
}

TEST_CASE("no percentile lies outside what was added: of one value they all are that value") {
  LogHistogram histogram;
  for (int i = 0; i < 1000; ++i) histogram.add(1'000'000);
  for (const double share : {0.0, 0.5, 0.99, 1.0}) CHECK(histogram.percentile(share) == 1e6);
  histogram.add(1'000'100);  // in the same bin
  CHECK(histogram.percentile(0.5) == 1e6);
  CHECK(histogram.percentile(1.0) == 1'000'100.0);
}
