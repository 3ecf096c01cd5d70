#include "workbench/session/history.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace tangent;

namespace {

ServoRecord record_of(std::uint64_t tick) {
  ServoRecord r;
  r.tick.tick = tick;
  r.tick.solve_ns = static_cast<double>(tick) * 2.0;
  return r;
}

}  // namespace

TEST_CASE("a history keeps the last records, oldest first") {
  History history(5);
  CHECK(history.empty());
  CHECK(history.find(0) == nullptr);
  for (std::uint64_t t = 0; t < 12; ++t) {
    history.push(record_of(t));
    const std::uint64_t first = t < 5 ? 0 : t - 4;
    REQUIRE(history.size() == t - first + 1);
    CHECK(history.oldest().tick.tick == first);
    CHECK(history.newest().tick.tick == t);
    for (std::size_t i = 0; i < history.size(); ++i) CHECK(history[i].tick.tick == first + i);
  }
  CHECK(history.memory_bytes() <= history.most_memory_bytes());
}

TEST_CASE("records are found by tick, also across drops and after wrapping") {
  History history(6);
  for (const std::uint64_t t : {1, 2, 3, 10, 11, 20, 21, 22, 40}) history.push(record_of(t));
  for (const std::uint64_t t : {10, 11, 20, 21, 22, 40}) {
    const ServoRecord* r = history.find(t);
    REQUIRE(r != nullptr);
    CHECK(r->tick.tick == t);
    CHECK(r->tick.solve_ns == 2.0 * static_cast<double>(t));
  }
  for (const std::uint64_t t : {0, 1, 3, 9, 12, 19, 23, 39, 41}) CHECK(history.find(t) == nullptr);
  CHECK(history.lower_bound(0) == 0);
  CHECK(history.lower_bound(12) == 2);
  CHECK(history.lower_bound(20) == 2);
  CHECK(history.lower_bound(41) == 6);
}

TEST_CASE("a tick that is not after the last begins a new history") {
  History history(4);
  for (const std::uint64_t t : {5, 6, 7, 8, 9}) history.push(record_of(t));
  history.push(record_of(0));
  CHECK(history.size() == 1);
  CHECK(history.newest().tick.tick == 0);
  for (const std::uint64_t t : {1, 2, 3, 4}) history.push(record_of(t));
  CHECK(history.oldest().tick.tick == 1);
}

TEST_CASE("memory stays within its bound however long the run") {
  History history(5000);
  for (std::uint64_t t = 0; t < 20'000; ++t) {
    history.push(record_of(t));
    REQUIRE(history.memory_bytes() <= history.most_memory_bytes());
  }
  CHECK(history.size() == 5000);
  CHECK(history.most_memory_bytes() <= (5000 + 2 * 1024) * sizeof(ServoRecord));
  for (std::size_t i = 0; i < history.size(); ++i) REQUIRE(history[i].tick.tick == 15'000 + i);
}

TEST_CASE("a snapshot keeps its records while the history moves on and wraps") {
  History history(3000);
  for (std::uint64_t t = 0; t < 3500; ++t) history.push(record_of(t));
  const HistorySnapshot before = history.snapshot();
  for (std::uint64_t t = 3500; t < 20'000; ++t) history.push(record_of(t));
  REQUIRE(before.size() == 3000);
  for (std::size_t i = 0; i < before.size(); ++i) REQUIRE(before[i].tick.tick == 500 + i);
  CHECK(before.lower_bound(1234) == 734);
  CHECK(before.lower_bound(99'999) == before.size());
  CHECK(history.oldest().tick.tick == 17'000);
}
