#include "workbench/gui/plots/channel_store.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace tangent;

namespace {

void push(ChannelStore& store, std::uint64_t tick, float value) { store.push(tick, std::vector<float>{value}); }

MinMax brute_force(const ChannelStore& store, std::uint64_t from, std::uint64_t to) {
  MinMax range;
  for (std::uint64_t t = from; t < to; ++t) range.include(store.value(0, t));
  return range;
}

}  // namespace

TEST_CASE("minima and maxima over any range equal those found sample by sample, also after the ring wrapped") {
  ChannelStore store(1, 1);  // one largest block: 262,144 ticks
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  std::bernoulli_distribution lost(0.01);
  const std::uint64_t start = 123'457;
  const std::uint64_t end = start + store.capacity() + 50'000;
  for (std::uint64_t tick = start; tick < end; ++tick) {
    if (!lost(random) || tick + 1 == end) push(store, tick, value(random));
  }
  CHECK(store.end_tick() == end);
  CHECK(store.first_tick() == end - store.capacity());
  std::uniform_int_distribution<std::uint64_t> at(store.first_tick() - 100, end + 100);
  for (int i = 0; i < 200; ++i) {
    std::uint64_t from = at(random), to = at(random);
    if (from > to) std::swap(from, to);
    const MinMax fast = store.min_max(0, from, to);
    const MinMax slow = brute_force(store, from, to);
    REQUIRE(fast.min == slow.min);
    REQUIRE(fast.max == slow.max);
  }
}

TEST_CASE("ticks that never came are gaps") {
  ChannelStore store(1, 1000);
  push(store, 10, 1.0f);
  push(store, 14, 2.0f);
  CHECK(store.value(0, 10) == 1.0f);
  CHECK(std::isnan(store.value(0, 12)));
  CHECK(store.value(0, 14) == 2.0f);
  CHECK(store.min_max(0, 11, 14).empty());
  CHECK(std::isnan(store.value(0, 9)));
  CHECK(std::isnan(store.value(0, 15)));
}

TEST_CASE("a tick that goes back starts another recording") {
  ChannelStore store(1, 1000);
  for (std::uint64_t t = 500; t < 600; ++t) push(store, t, 1.0f);
  push(store, 3, -4.0f);
  CHECK(store.first_tick() == 3);
  CHECK(store.end_tick() == 4);
  CHECK(store.min_max(0, 0, 1000).min == -4.0f);
  CHECK(store.min_max(0, 0, 1000).max == -4.0f);
  CHECK(std::isnan(store.value(0, 550)));
}

TEST_CASE("a jump longer than the store forgets what was before it") {
  ChannelStore store(1, 1000);
  push(store, 5, 9.0f);
  push(store, 5 + 10 * store.capacity(), 1.0f);
  CHECK(store.min_max(0, 0, store.end_tick()).max == 1.0f);
}
