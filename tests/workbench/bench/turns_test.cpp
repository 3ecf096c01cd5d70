// What takes turns: order, intervals, ranks and ties, on times that are made up.
#include "workbench/bench/turns.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::bench;

namespace {

/// Competitors that say when they ran, each tick of it taking `ns` times what the machine does in that round.
struct FakeRace {
  std::vector<std::size_t> log;
  double load = 1.0;

  TimedPass pass(std::size_t who, double ns) {
    return [this, who, ns] {
      log.push_back(who);
      return std::vector<double>(8, ns * load);
    };
  }
  std::vector<TimedPass> passes(const std::vector<double>& ns) {
    std::vector<TimedPass> out;
    for (std::size_t i = 0; i < ns.size(); ++i) out.push_back(pass(i, ns[i]));
    return out;
  }
};

}  // namespace

TEST_CASE("a round runs each competitor once, in an order of its own that the seed alone decides") {
  FakeRace race, again, other;
  const std::vector<double> ns{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  Turns turns(race.passes(ns), {.seed = 5}), same(again.passes(ns), {.seed = 5}),
      else_seeded(other.passes(ns), {.seed = 6});
  for (int round = 0; round < 6; ++round) {
    REQUIRE(turns.round());
    REQUIRE(same.round());
    REQUIRE(else_seeded.round());
  }
  CHECK(turns.rounds() == 6);
  CHECK(race.log == again.log);
  CHECK(race.log != other.log);
  std::vector<std::vector<std::size_t>> orders;
  for (int round = 0; round < 6; ++round) {
    const auto begin = race.log.begin() + 7 * round;
    std::vector<std::size_t> order(begin, begin + 7);
    orders.push_back(order);
    std::sort(order.begin(), order.end());
    CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6});
  }
  std::sort(orders.begin(), orders.end());
  CHECK(std::unique(orders.begin(), orders.end()) - orders.begin() >= 5);
}

TEST_CASE("ratios are those of the same round, whatever the machine does from round to round") {
  FakeRace race;
  Turns turns(race.passes({200.0, 100.0, 102.0, 104.0}), {.keep_least = true});
  for (const double load : {1.0, 3.0, 1.5, 9.0, 2.0, 1.0}) {
    race.load = load;
    REQUIRE(turns.round());
  }
  const auto ranks = ranked(turns, std::array<std::size_t, 4>{0, 1, 2, 3});
  REQUIRE(ranks.size() == 4);
  CHECK(ranks[0].competitor == 1);
  CHECK_FALSE(ranks[0].tie);
  CHECK(ranks[1].competitor == 2);
  CHECK(ranks[1].tie);
  CHECK(ranks[1].to_fastest.ratio == approx(1.02));
  CHECK_FALSE(ranks[2].tie);
  CHECK(ranks[3].to_fastest.ratio == approx(2.0));
  CHECK(ranks[3].to_fastest.high == approx(2.0));
  CHECK(ranked(turns, std::array<std::size_t, 2>{0, 3}).front().competitor == 3);
  CHECK(turns.least_ns(0) == std::vector<double>(8, 200.0));
  const TickTimes times = times_of(turns.of(1));
  CHECK(times.mean_ns.median == approx(175.0));
  CHECK(times.mean_ns.low == approx(100.0));
  CHECK(times.mean_ns.high == approx(900.0));
  CHECK(times.p99_ns.coverage > 0.95);
}

TEST_CASE("a tick's times of a round are its mean, median, 99th percentile and middle mean") {
  Turns turns({[] {
    std::vector<double> ns;
    for (int i = 1; i <= 100; ++i) ns.push_back(i == 100 ? 1000.0 : i);
    return ns;
  }});
  REQUIRE(turns.round());
  CHECK(turns.of(0).mean_ns.front() == approx(59.5));
  CHECK(turns.of(0).p50_ns.front() == 50.0);
  CHECK(turns.of(0).p99_ns.front() == 99.0);
  CHECK(turns.of(0).typical_ns.front() == approx(50.5));
}

TEST_CASE("a round that is stopped counts for none of its competitors") {
  int left = 5;
  const TimedPass pass = [&left] { return --left < 0 ? std::vector<double>() : std::vector<double>{7.0}; };
  Turns turns({pass, pass, pass});
  CHECK(turns.round());
  CHECK_FALSE(turns.round());
  CHECK(turns.rounds() == 1);
  for (std::size_t i = 0; i < 3; ++i) CHECK(turns.of(i).mean_ns.size() == 1);
}

TEST_CASE("there and back, a round runs the reverse of its order, too, and of each tick the lesser time counts") {
  std::vector<std::size_t> log;
  int disturbed = 0;
  std::vector<TimedPass> passes;
  for (std::size_t i = 0; i < 5; ++i)
    passes.push_back([&, i] {
      log.push_back(i);
      std::vector<double> ns(10, 100.0 * static_cast<double>(i + 1));
      ns[static_cast<std::size_t>(disturbed++ % 10)] = 1e7;  // another tick in every pass
      return ns;
    });
  Turns turns(std::move(passes), {.seed = 4, .there_and_back = true});
  REQUIRE(turns.round());
  REQUIRE(log.size() == 10);
  for (std::size_t k = 0; k < 5; ++k) CHECK(log[k] == log[9 - k]);
  for (std::size_t i = 0; i < 5; ++i) CHECK(turns.of(i).mean_ns.front() == approx(100.0 * static_cast<double>(i + 1)));
  CHECK(turns.rounds() == 1);
}
