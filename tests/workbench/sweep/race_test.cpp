#include "workbench/sweep/race.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tangent::sweep {
namespace {

TEST_CASE("blocks hold every tick once, each ground's spread over its motion, the grounds in turn") {
  const std::vector<TickSpan> grounds{{0, 12'146}, {100, 4'100}, {0, 30}};
  const std::vector<Block> blocks = blocks_of(grounds);
  for (std::size_t g = 0; g < grounds.size(); ++g) {
    std::vector<Block> mine;
    for (const Block& block : blocks)
      if (block.ground == g) mine.push_back(block);
    const std::size_t count = std::max<std::size_t>(1, (grounds[g].end - grounds[g].begin) / kBlockTicks);
    REQUIRE(mine.size() == count);
    if (count >= 4) {  // of the first four, one in each quarter
      std::array<int, 4> quarters{};
      for (std::size_t i = 0; i < 4; ++i)
        ++quarters[4 * (mine[i].first + mine[i].count / 2 - grounds[g].begin) / (grounds[g].end - grounds[g].begin)];
      CHECK(quarters == std::array<int, 4>{1, 1, 1, 1});
    }
    std::sort(mine.begin(), mine.end(), [](const Block& a, const Block& b) { return a.first < b.first; });
    std::size_t next = grounds[g].begin;
    for (const Block& block : mine) {
      CHECK(block.first == next);
      CHECK((count == 1 || block.count >= kBlockTicks));
      next += block.count;
    }
    CHECK(next == grounds[g].end);
  }
  for (std::size_t i = 0; i < 3; ++i) CHECK(blocks[i].ground == i);
}

/// Blocks of two objectives: a level of each, and noise that both trials meet (the ground's) and each by itself.
std::vector<BlockCosts> costs(double first, double second, double own, unsigned seed, std::size_t blocks) {
  std::mt19937 ground(7), mine(seed);
  std::normal_distribution<double> of_ground, of_mine;
  std::vector<BlockCosts> out(1);
  for (std::size_t i = 0; i < blocks; ++i) {
    const double shared = std::exp(of_ground(ground));
    const auto cost = [&](double level) { return level * shared * std::exp(own * of_mine(mine)); };
    const double one = cost(first);
    out[0].push_back({one, cost(second)});
  }
  return out;
}

TEST_CASE("a race drops what is surely worse in everything, and only that") {
  const Race race(1, 24);
  int worse = 0, even = 0, traded = 0, few = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    const auto best = costs(1.0, 1.0, 0.1, 1000 + seed, 24);
    worse += race.beaten(costs(1.5, 1.5, 0.1, seed, 10), best, 2);
    even += race.beaten(costs(1.0, 1.0, 0.1, seed, 10), best, 2);
    traded += race.beaten(costs(1.5, 0.5, 0.1, seed, 10), best, 2);
    few += race.beaten(costs(9.0, 9.0, 0.1, seed, Race::kFewestBlocks - 1), best, 2);
  }
  CHECK(worse == 500);
  CHECK(even <= 5);  // 0.05 squared of 500, and some
  CHECK(traded == 0);
  CHECK(few == 0);
}

TEST_CASE("an objective that is the same block by block does not keep a worse trial in") {
  const Race race(2, 24);
  const auto flat = [](double first) {
    std::vector<BlockCosts> out(2);
    for (std::size_t i = 0; i < 6; ++i)
      for (auto& ground : out) ground.push_back({first + 0.01 * static_cast<double>(i % 2), 3.0});
    return out;
  };
  CHECK(race.beaten(flat(2.0), flat(1.0), 2));
  CHECK(!race.beaten(flat(1.0), flat(1.0), 2));  // as good: stays
  auto one_ground = flat(2.0);
  one_ground[1] = flat(0.5)[1];
  CHECK(!race.beaten(one_ground, flat(1.0), 2));  // better on the other ground
}

TEST_CASE("values are above a limit when their mean surely is") {
  const Race race(1, 24);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int at = 0, over = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> values;
    for (int k = 0; k < 8; ++k) values.push_back(1.0 + 0.1 * normal(random));
    at += race.above(values, 1.0);
    over += race.above(values, 0.8);
  }
  CHECK(at <= 70);  // 5 % of 1000 and some
  CHECK(over >= 950);
  CHECK(!race.above(std::vector<double>(4, 9.0), 1.0));
  CHECK(race.above(std::vector<double>(5, 9.0), 1.0));
}

}  // namespace
}  // namespace tangent::sweep
