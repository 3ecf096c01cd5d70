#include "devices/base/mailbox.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

using namespace tangent;

TEST_CASE("a mailbox gives the latest letter once") {
  Mailbox<int> box;
  int letter = -1;
  CHECK_FALSE(box.take(letter));
  CHECK(letter == -1);
  box.put(1);
  box.put(2);
  box.put(3);
  CHECK(box.take(letter));
  CHECK(letter == 3);
  CHECK_FALSE(box.take(letter));
  box.put(4);
  CHECK(box.take(letter));
  CHECK(letter == 4);
}

TEST_CASE("letters are never torn, never go back, and the last one arrives") {
  using Letter = std::array<std::uint64_t, 40>;  // larger than a cache line
  Mailbox<Letter> box;
  constexpr std::uint64_t kLetters = 200'000;
  std::atomic<bool> reading{false};
  std::thread writer([&] {
    while (!reading) std::this_thread::yield();
    for (std::uint64_t i = 1; i <= kLetters; ++i) {
      Letter letter;
      letter.fill(i);
      box.put(letter);
      // Give the reader a chance now and then, also where both threads share a core.
      if (i % 64 == 0) std::this_thread::yield();
    }
  });
  std::uint64_t last = 0, taken = 0, torn = 0, back = 0;
  reading = true;
  while (last < kLetters) {
    Letter letter;
    if (!box.take(letter)) {
      std::this_thread::yield();
      continue;
    }
    ++taken;
    torn += !std::all_of(letter.begin(), letter.end(), [&](std::uint64_t v) { return v == letter[0]; });
    back += letter[0] <= last;
    last = letter[0];
  }
  writer.join();
  CHECK(torn == 0);
  CHECK(back == 0);
  CHECK(last == kLetters);
  MESSAGE("letters taken: " << taken << " of " << kLetters);
}
