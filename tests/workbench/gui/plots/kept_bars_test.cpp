#include "workbench/gui/plots/kept_bars.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace tangent;

namespace {

/// Reference: column by column and tick by tick, without pyramid and cache.
std::vector<ColumnBar> brute_force(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width) {
  const PixelColumns columns = pixel_columns(store, axis, width);
  std::vector<ColumnBar> out;
  for (std::int64_t column = columns.first; column < columns.end; ++column) {
    MinMax range;
    for (std::uint64_t t = columns.tick_of(column); t < columns.tick_of(column + 1); ++t)
      range.include(store.value(channel, t));
    if (!range.empty()) out.push_back({columns.x_of(column), range});
  }
  return out;
}

void require_same(const std::vector<ColumnBar>& a, const std::vector<ColumnBar>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].x == b[i].x);
    REQUIRE(a[i].range.min == b[i].range.min);
    REQUIRE(a[i].range.max == b[i].range.max);
  }
}

struct Noise {
  std::mt19937 random{5};
  std::uniform_real_distribution<float> value{-1.0f, 1.0f};
  std::bernoulli_distribution lost{0.02};

  std::vector<float> row() { return {value(random), value(random)}; }
  void push(ChannelStore& store, std::uint64_t ticks) {
    const std::uint64_t end = store.end_tick() + ticks;
    for (std::uint64_t t = store.end_tick(); t < end; ++t) {
      if (t + 1 == end || !lost(random)) store.push(t, row());
    }
  }
};

}  // namespace

TEST_CASE("kept bars are those computed anew, whatever is done to axis and store") {
  ChannelStore store(2, 1);
  Noise noise;
  store.push(262'000, noise.row());
  noise.push(store, 150'000);
  TimeAxis axis;
  KeptBars kept;
  float width = 400.0f;
  std::size_t channel = 0;
  std::uniform_int_distribution<int> what(0, 11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    switch (what(noise.random)) {
      case 0:
        axis.follow();
        break;
      case 1:
        axis.show(262'000.0 + 150'000.0 * share(noise.random), 262'000.0 + 300'000.0 * share(noise.random));
        break;
      case 2:
        axis.zoom(0.7, axis.from() + share(noise.random) * axis.span());
        break;
      case 3:
        axis.zoom(1.4, axis.from() + share(noise.random) * axis.span());
        break;
      case 4:
        axis.pan((share(noise.random) - 0.5) * 0.2 * axis.span());
        break;
      case 5:
        axis.set_span(static_cast<double>(width) * std::floor(3.0 + 200.0 * share(noise.random)));
        break;
      case 6:
        width = 300.0f + 50.0f * static_cast<float>(what(noise.random));
        break;
      case 7:
        channel = 1 - channel;
        break;
      case 8:
        noise.push(store, 17'000);
        break;  // now and then past the end of the ring
      default:
        noise.push(store, 16);
        break;
    }
    axis.update(store.first_tick(), store.end_tick(), static_cast<double>(store.capacity()));
    require_same(kept.update(store, channel, axis, width), brute_force(store, channel, axis, width));
  }
  CHECK(store.first_tick() > 262'000);
}

TEST_CASE("a frame that scrolls computes the columns that are new, a still one next to none") {
  ChannelStore store(2, 1);
  Noise noise;
  noise.push(store, 100'000);
  TimeAxis axis;
  axis.update(0, store.end_tick(), 1e6);
  axis.set_span(80'000.0);
  axis.update(0, store.end_tick(), 1e6);
  KeptBars kept;
  kept.update(store, 0, axis, 800.0f);
  CHECK(kept.computed() >= 800);
  CHECK(kept.computed() <= 901);
  kept.update(store, 0, axis, 800.0f);
  CHECK(kept.computed() <= 1);  // the newest, which isn't full yet
  for (int frame = 0; frame < 50; ++frame) {
    noise.push(store, 16);
    axis.update(0, store.end_tick(), 1e6);
    kept.update(store, 0, axis, 800.0f);
    CHECK(kept.computed() <= 2);
  }
  axis.pan(-1000.0);  // ten pixels
  kept.update(store, 0, axis, 800.0f);
  CHECK(kept.computed() <= 13);
}

TEST_CASE("another recording, other rows and another store are not taken for the last one") {
  ChannelStore store(1, 1), other(1, 1);
  std::vector<float> rows(50'000, 1.0f);
  TimeAxis axis;
  axis.update(0, 50'000, 1e6);
  axis.show(0.0, 50'000.0);
  KeptBars kept;
  const auto most = [&](const ChannelStore& of) { return kept.update(of, 0, axis, 500.0f)[100].range.max; };
  store.assign(0, rows);
  CHECK(most(store) == 1.0f);
  rows.assign(rows.size(), 2.0f);
  store.assign(0, rows);
  CHECK(most(store) == 2.0f);
  rows.assign(rows.size(), 3.0f);
  other.assign(0, rows);
  CHECK(most(other) == 3.0f);
  store.clear();
  CHECK(kept.update(store, 0, axis, 500.0f).empty());
  for (std::uint64_t t = 0; t < 50'000; ++t) store.push(t, std::vector<float>{4.0f});
  CHECK(most(store) == 4.0f);
}
