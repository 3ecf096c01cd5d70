#include "core/base/built_once.h"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

using namespace tangent;

TEST_CASE("a value is made when it is first asked for, and once") {
  const BuiltOnce<std::vector<int>> value;
  CHECK(value.if_built() == nullptr);
  int made = 0;
  const auto make = [&made] { return std::vector<int>{++made}; };
  const std::vector<int>& first = value.get(make);
  CHECK(first == std::vector<int>{1});
  CHECK(&value.get(make) == &first);
  CHECK(value.if_built() == &first);
  CHECK(made == 1);
}

TEST_CASE("threads that ask at once get the same value at the same place") {
  for (int round = 0; round < 50; ++round) {
    const BuiltOnce<std::vector<int>> value;
    std::vector<const std::vector<int>*> got(4);
    std::vector<std::thread> threads;
    for (auto& place : got) threads.emplace_back([&] { place = &value.get([] { return std::vector<int>(1000, 7); }); });
    for (std::thread& thread : threads) thread.join();
    for (const auto* place : got) CHECK(place == got[0]);
    CHECK(value.if_built() == got[0]);
    CHECK(*got[0] == std::vector<int>(1000, 7));
  }
}
