#include "devices/plugin/shared_slot.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

using namespace tangent;

namespace {

using Twelve = std::array<std::uint64_t, 12>;

Twelve all(std::uint64_t value) {
  Twelve made{};
  made.fill(value);
  return made;
}

}  // namespace

TEST_CASE("a shared slot gives the newest value once") {
  SharedSlot<Twelve> slot;
  Twelve value{};
  std::uint32_t last = 0;
  CHECK_FALSE(slot.take(value, last));
  slot.put(all(1));
  slot.put(all(2));
  CHECK(slot.take(value, last));
  CHECK(value == all(2));
  CHECK_FALSE(slot.take(value, last));
  slot.put(all(3));
  CHECK(slot.take(value, last));
  CHECK(value == all(3));
}

TEST_CASE("what is taken from a shared slot while it is written is whole, and never older than before") {
  constexpr std::uint64_t kValues = 20'000;
  SharedSlot<Twelve> slot;
  std::atomic<bool> written{false};
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kValues; ++i) slot.put(all(i));
    written.store(true);
  });
  Twelve value{};
  std::uint32_t last = 0;
  std::uint64_t newest = 0, torn = 0, back = 0;
  for (bool over = false; !over;) {
    over = written.load();  // before the last look
    if (!slot.take(value, last)) continue;
    torn += std::count(value.begin(), value.end(), value[0]) == 12 ? 0 : 1;
    back += value[0] > newest ? 0 : 1;
    newest = value[0];
  }
  writer.join();
  CHECK(torn == 0);
  CHECK(back == 0);
  CHECK(newest == kValues);
}
