#include "workbench/gui/plots/sample_cells.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

using namespace tangent;

namespace {

ChannelStore noise(std::uint64_t ticks) {
  std::mt19937 random(5);
  std::normal_distribution<float> value(0.0f, 1.0f);
  std::vector<float> rows;
  for (std::uint64_t t = 0; t < ticks; ++t) {
    rows.push_back(t % 1000 == 7 ? std::nanf("") : value(random));
    rows.push_back(value(random));
  }
  ChannelStore store(2, ticks);
  store.assign(0, rows);
  return store;
}

int frames_until_done(SampleCells& cells, const ChannelStore& store, const CellQuery& query) {
  int frames = 0;
  do {
    cells.update(store, query);
    ++frames;
  } while (cells.busy());
  return frames;
}

}  // namespace

TEST_CASE("every sample of the range is counted once, in the cell it belongs to") {
  const ChannelStore store = noise(30'000);
  SampleCells cells;
  const CellQuery query{0, std::nullopt, 1000, 29'000, 40, 1};
  CHECK(frames_until_done(cells, store, query) == 1);
  std::vector<std::uint32_t> slow(40);
  const MinMax range = store.min_max(0, 1000, 29'000);
  std::uint64_t total = 0;
  for (std::uint64_t t = 1000; t < 29'000; ++t) {
    const float v = store.value(0, t);
    if (std::isnan(v)) continue;
    ++total;
    const double share = static_cast<double>(v - range.min) / static_cast<double>(range.max - range.min);
    ++slow[std::min<std::size_t>(39, static_cast<std::size_t>(share * 40.0))];
  }
  CHECK(cells.total() == total);
  std::uint64_t apart = 0;
  for (std::size_t i = 0; i < 40; ++i)
    apart +=
        static_cast<std::uint64_t>(std::abs(static_cast<double>(cells.counts()[i]) - static_cast<double>(slow[i])));
  CHECK(apart <= 4);  // rounding at a cell's border
  CHECK(std::accumulate(cells.counts().begin(), cells.counts().end(), std::uint64_t{0}) == total);
}

TEST_CASE("many samples take several frames, and the old counts stay until the new are whole") {
  const ChannelStore store = noise(350'000);
  SampleCells cells;
  const CellQuery query{0, std::size_t{1}, 0, 350'000, 64, 32};
  CHECK(frames_until_done(cells, store, query) == 4);
  CHECK(cells.total() == 350'000 - 350);
  cells.update(store, query);  // the same again: nothing to do
  CHECK_FALSE(cells.busy());
  CellQuery next = query;
  next.from = 1000;
  cells.update(store, next);
  CHECK(cells.busy());
  CHECK(cells.query() == query);
  CHECK(frames_until_done(cells, store, next) == 3);
  CHECK(cells.query() == next);
}

TEST_CASE("a constant and an empty range are counted without a fault") {
  ChannelStore store(1, 1);
  for (std::uint64_t t = 0; t < 100; ++t) store.push(t, std::vector<float>{2.5f});
  SampleCells cells;
  CHECK(frames_until_done(cells, store, {0, std::nullopt, 0, 100, 10, 1}) == 1);
  CHECK(cells.counts()[0] == 100);
  CHECK(frames_until_done(cells, store, {0, std::nullopt, 500, 600, 10, 1}) == 1);
  CHECK(cells.total() == 0);
}
