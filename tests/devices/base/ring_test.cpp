#include "devices/base/ring.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <thread>

using namespace tangent;

TEST_CASE("a ring keeps its order, and counts what finds it full") {
  Ring<int> ring(4);
  int out = 0;
  CHECK_FALSE(ring.pop(out));
  CHECK(ring.room() == 4);
  for (int i = 0; i < 7; ++i) CHECK(ring.push(i) == (i < 4));
  CHECK(ring.drops() == 3);
  for (int i = 0; i < 4; ++i) {
    REQUIRE(ring.pop(out));
    CHECK(out == i);
  }
  CHECK_FALSE(ring.pop(out));
  CHECK(ring.push(9));
  CHECK(ring.pop(out));
  CHECK(out == 9);
  CHECK(ring.drops() == 3);
}

TEST_CASE("between two threads every item arrives in order or is counted as dropped") {
  Ring<std::uint64_t> ring(64);
  constexpr std::uint64_t kItems = 200'000;
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= kItems; ++i) {
      ring.push(i);
      if (i % 50 == 0) std::this_thread::yield();
    }
    while (!ring.push(kItems + 1)) std::this_thread::yield();
  });
  std::uint64_t last = 0, came = 0, disorder = 0, item = 0;
  while (last != kItems + 1) {
    if (!ring.pop(item)) {
      std::this_thread::yield();
      continue;
    }
    disorder += item <= last;
    last = item;
    ++came;
  }
  producer.join();
  CHECK(disorder == 0);
  // Tries to push the end mark may have been dropped too.
  CHECK(came + ring.drops() >= kItems + 1);
  CHECK(came <= kItems + 1);
}
