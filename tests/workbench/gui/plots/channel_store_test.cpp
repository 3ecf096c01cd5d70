#include "workbench/gui/plots/channel_store.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

using namespace tangent;
using namespace tangent::test;

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
  // Of a few ticks: everywhere about the ends of what is kept and the ring's.
  for (const std::uint64_t around : {store.first_tick(), store.capacity(), end}) {
    for (std::uint64_t from = around - 30; from < around + 10; ++from) {
      for (std::uint64_t count = 0; count < 40; ++count) {
        REQUIRE(store.min_max(0, from, from + count).min == brute_force(store, from, from + count).min);
        REQUIRE(store.min_max(0, from, from + count).max == brute_force(store, from, from + count).max);
      }
    }
  }
}

TEST_CASE(
    "a row of ranges equals its ranges found sample by sample: whole blocks, odd ones, over the ring's end, beyond "
    "what is kept") {
  ChannelStore store(1, 1);
  std::mt19937 random(17);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  std::bernoulli_distribution lost(0.3);
  for (std::uint64_t tick = 200'003; tick < 500'000; ++tick) {
    if (!lost(random)) push(store, tick, value(random));
  }
  std::vector<MinMax> row(40);
  for (const std::uint64_t ticks : {3u, 8u, 9u, 16u, 24u, 60u, 64u, 120u, 176u, 448u, 480u, 512u, 513u, 3584u, 7680u}) {
    for (const std::uint64_t around :
         {store.first_tick(), std::uint64_t{262'144}, std::uint64_t{400'000}, store.end_tick()}) {
      const std::uint64_t from = (around / ticks - 20) * ticks;
      store.min_max_row(0, from, ticks, row);
      for (std::size_t i = 0; i < row.size(); ++i) {
        const MinMax slow = brute_force(store, from + i * ticks, from + (i + 1) * ticks);
        REQUIRE(row[i].min == slow.min);
        REQUIRE(row[i].max == slow.max);
      }
    }
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

TEST_CASE("means and RMS over any range equal those summed sample by sample") {
  ChannelStore store(1, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-1.0f, 3.0f);
  std::bernoulli_distribution lost(0.02);
  for (std::uint64_t tick = 1000; tick < 1000 + store.capacity() + 30'000; ++tick) {
    if (!lost(random)) push(store, tick, value(random));
  }
  std::uniform_int_distribution<std::uint64_t> at(store.first_tick() - 50, store.end_tick() + 50);
  for (int i = 0; i < 50; ++i) {
    std::uint64_t from = at(random), to = at(random);
    if (from > to) std::swap(from, to);
    SampleSums slow;
    for (std::uint64_t t = from; t < to; ++t) slow.include(store.value(0, t));
    const SampleSums fast = store.sums(0, from, to);
    REQUIRE(fast.count == slow.count);
    if (slow.count == 0) continue;
    REQUIRE(fast.mean() == approx(slow.mean()).epsilon(1e-9));
    REQUIRE(fast.rms() == approx(slow.rms()).epsilon(1e-9));
  }
}

TEST_CASE("assigned rows answer as pushed ones, and pushing goes on after them") {
  const std::uint64_t first = 262'100;  // inside blocks of every size, across the largest one's border
  std::mt19937 random(11);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  std::bernoulli_distribution lost(0.05);
  std::vector<float> rows;
  ChannelStore pushed(2, 1), assigned(2, 1);
  for (std::uint64_t t = 0; t < 40'000; ++t) {
    float row[2] = {value(random), value(random)};
    if (t > 0 && lost(random)) row[0] = row[1] = std::nanf("");
    rows.insert(rows.end(), {row[0], row[1]});
    pushed.push(first + t, row);
  }
  for (std::uint64_t t = 0; t < 500; ++t) assigned.push(t, std::vector<float>{99.0f, 99.0f});  // is forgotten
  assigned.assign(first, rows);
  for (std::uint64_t t = 40'000; t < 42'000; ++t) {
    const float row[2] = {value(random), value(random)};
    pushed.push(first + t, row);
    assigned.push(first + t, row);
  }
  REQUIRE(assigned.first_tick() == pushed.first_tick());
  REQUIRE(assigned.end_tick() == pushed.end_tick());
  std::uniform_int_distribution<std::uint64_t> at(first - 10, first + 42'010);
  for (int i = 0; i < 300; ++i) {
    std::uint64_t from = at(random), to = at(random);
    if (from > to) std::swap(from, to);
    for (std::size_t channel = 0; channel < 2; ++channel) {
      REQUIRE(assigned.min_max(channel, from, to).min == pushed.min_max(channel, from, to).min);
      REQUIRE(assigned.min_max(channel, from, to).max == pushed.min_max(channel, from, to).max);
      REQUIRE(assigned.sums(channel, from, to).count == pushed.sums(channel, from, to).count);
    }
  }
}

TEST_CASE("more rows than there is room for: the newest are kept") {
  ChannelStore store(1, 1);
  std::vector<float> rows(store.capacity() + 1000, 0.0f);
  rows[10] = 5.0f;
  rows.back() = 7.0f;
  store.assign(50, rows);
  CHECK(store.first_tick() == 1050);
  CHECK(store.end_tick() == 1050 + store.capacity());
  CHECK(store.min_max(0, 0, store.end_tick()).max == 7.0f);
  CHECK(store.min_max(0, 0, store.end_tick() - 1).max == 0.0f);
}

TEST_CASE("a spike of one sample in an hour at 1 kHz is found in every range that holds it, and in no other") {
  constexpr std::uint64_t hour = 3'600'000, spike = 2'222'222;
  std::vector<float> rows(hour, 0.25f);
  rows[spike] = 50.0f;
  ChannelStore store(1, hour);
  store.assign(0, rows);
  for (std::uint64_t half = 1; half < hour; half = half * 3 / 2 + 1) {
    const std::uint64_t from = spike > half ? spike - half : 0;
    CHECK(store.min_max(0, from, spike + half).max == 50.0f);
    CHECK(store.min_max(0, from, spike).max == 0.25f);
    CHECK(store.min_max(0, spike + 1, spike + 1 + half).max == 0.25f);
  }
}

TEST_CASE("a store that keeps a part and knows the rest by blocks: exact inside, rounded out to blocks beyond") {
  constexpr std::uint64_t kTicks = 40'000, kBlock = 256, kFrom = 13'000, kTo = 17'500;
  ChannelStore whole(1, 1), part(1, 1);
  auto blocks = std::make_shared<ChannelStore>(2, 1);
  std::mt19937 random(3);
  std::normal_distribution<float> value;
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) push(whole, tick, value(random));
  for (std::uint64_t b = 0; b * kBlock < kTicks; ++b) {
    const MinMax range = whole.min_max(0, b * kBlock, (b + 1) * kBlock);
    blocks->push(b, std::vector<float>{range.min, range.max});
  }
  for (std::uint64_t tick = kFrom; tick < kTo; ++tick) push(part, tick, whole.value(0, tick));
  const std::uint64_t before = part.generation();
  part.set_coarse({blocks, kBlock, 0, kTicks});
  CHECK(part.generation() != before);
  CHECK(part.first_tick() == 0);
  CHECK(part.end_tick() == kTicks);
  CHECK(part.first_kept() == kFrom);
  CHECK(part.end_kept() == kTo);
  std::uniform_int_distribution<std::uint64_t> at(0, kTicks);
  const auto down = [](std::uint64_t t) { return t / kBlock * kBlock; };
  const auto up = [](std::uint64_t t) { return (t + kBlock - 1) / kBlock * kBlock; };
  for (int i = 0; i < 400; ++i) {
    std::uint64_t from = at(random), to = at(random);
    if (from > to) std::swap(from, to);
    if (from == to) continue;
    MinMax wanted;
    if (from < kFrom) wanted.include(whole.min_max(0, down(from), up(std::min(to, kFrom))));
    if (to > kTo) wanted.include(whole.min_max(0, down(std::max(from, kTo)), up(to)));
    wanted.include(whole.min_max(0, std::clamp(from, kFrom, kTo), std::clamp(to, kFrom, kTo)));
    const MinMax found = part.min_max(0, from, to);
    CHECK(found.min == wanted.min);
    CHECK(found.max == wanted.max);
    std::vector<MinMax> row(3);
    part.min_max_row(0, down(from), kBlock, row);
    for (std::uint64_t k = 0; k < row.size(); ++k)
      CHECK(row[k].max >= whole.min_max(0, down(from) + k * kBlock, down(from) + (k + 1) * kBlock).max);
    const bool inside = from >= kFrom && to <= kTo;
    CHECK(part.sums(0, from, to).count == (inside ? to - from : 0));
  }
  CHECK(std::isnan(part.value(0, kFrom - 1)));
  CHECK(part.value(0, kFrom) == whole.value(0, kFrom));
}
