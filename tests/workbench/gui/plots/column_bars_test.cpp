#include "workbench/gui/plots/column_bars.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace tangent;

namespace {

ChannelStore sine_with_spike(std::uint64_t count, std::uint64_t spike_at) {
  ChannelStore store(1, count);
  for (std::uint64_t t = 0; t < count; ++t) {
    store.push(t,
               std::vector<float>{t == spike_at ? 50.0f : static_cast<float>(std::sin(static_cast<double>(t) * 1e-3))});
  }
  return store;
}

}  // namespace

TEST_CASE("a spike of one sample among 100,000 shows at every zoom, in the column it belongs to") {
  const std::uint64_t spike = 61'803;
  const ChannelStore store = sine_with_spike(100'000, spike);
  std::vector<ColumnBar> bars;
  std::vector<SamplePoint> points;
  for (const float width : {211.0f, 640.0f, 1280.0f, 3840.0f}) {
    for (double span = 100'000.0; span > 10.0; span *= 0.83) {
      TimeAxis axis;
      axis.update(store.first_tick(), store.end_tick(), 1e6);
      axis.show(static_cast<double>(spike) - 0.37 * span, static_cast<double>(spike) + 0.63 * span);
      const double x = axis.x_at(static_cast<double>(spike), 0.0, static_cast<double>(width));
      CAPTURE(width);
      CAPTURE(span);
      int seen = 0;
      if (axis.span() / static_cast<double>(width) >= kTicksPerColumnForBars) {
        column_bars(store, 0, axis, width, bars);
        for (const ColumnBar& bar : bars) {
          if (bar.range.max < 50.0f) continue;
          ++seen;
          REQUIRE(std::abs(static_cast<double>(bar.x) - x) <= 1.01);
        }
      } else {
        sample_points(store, 0, axis, width, points);
        for (const SamplePoint& point : points) {
          if (point.value < 50.0f) continue;
          ++seen;
          REQUIRE(std::abs(static_cast<double>(point.x) - x) <= 1e-2);
        }
      }
      REQUIRE(seen == 1);
    }
  }
}

TEST_CASE("columns keep their ticks while the axis scrolls") {
  const ChannelStore store = sine_with_spike(50'000, 20'000);
  TimeAxis axis;
  axis.update(0, 50'000, 1e6);
  axis.show(10'000.0, 30'000.0);
  std::vector<ColumnBar> before, after;
  column_bars(store, 0, axis, 800.0f, before);
  axis.pan(25.0);  // one column
  column_bars(store, 0, axis, 800.0f, after);
  REQUIRE(before.size() > 700);
  for (std::size_t i = 0; i < 700; ++i) {
    REQUIRE(after[i].range.min == before[i + 1].range.min);
    REQUIRE(after[i].range.max == before[i + 1].range.max);
  }
}

TEST_CASE("an empty store and one far outside the view draw nothing") {
  TimeAxis axis;
  std::vector<ColumnBar> bars;
  std::vector<SamplePoint> points;
  ChannelStore store(1, 100);
  column_bars(store, 0, axis, 800.0f, bars);
  sample_points(store, 0, axis, 800.0f, points);
  CHECK(bars.empty());
  CHECK(points.empty());
  store.push(5, std::vector<float>{1.0f});
  axis.update(0, 1'000'000, 1e9);
  axis.show(500'000, 600'000);
  column_bars(store, 0, axis, 800.0f, bars);
  sample_points(store, 0, axis, 800.0f, points);
  CHECK(bars.empty());
  CHECK(points.empty());
}

TEST_CASE("a line isn't drawn across a gap") {
  ChannelStore store(1, 1000);
  for (std::uint64_t t = 0; t < 100; ++t) {
    if (t != 50) store.push(t, std::vector<float>{1.0f});
  }
  TimeAxis axis;
  axis.update(0, 100, 1e6);
  axis.show(0, 100);
  std::vector<SamplePoint> points;
  sample_points(store, 0, axis, 1000.0f, points);
  REQUIRE(points.size() == 99);
  CHECK(points[0].after_gap);
  CHECK_FALSE(points[49].after_gap);
  CHECK(points[50].after_gap);
}
