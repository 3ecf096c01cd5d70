#include "workbench/experiment/order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

namespace tangent::experiment {
namespace {

Identification paper_design() {
  Identification d;
  d.objects = {"cone", "cylinder", "cube", "sphere", "tetrahedron", "octagon", "triangle"};
  d.both_ways = {"cone", "tetrahedron"};
  d.practice = "hexagon";
  return d;
}

TEST_CASE("Latin squares: every condition once in every place, and after every other equally often") {
  for (const std::size_t n : {1u, 2u, 3u, 4u, 5u, 6u, 7u}) {
    const std::size_t rows = n % 2 == 0 ? n : 2 * n;
    std::map<std::pair<std::size_t, std::size_t>, int> in_place, follows;
    for (std::size_t participant = 0; participant < rows; ++participant) {
      const auto row = latin_row(n, participant);
      REQUIRE(std::set<std::size_t>(row.begin(), row.end()).size() == n);
      for (std::size_t i = 0; i < n; ++i) {
        ++in_place[{i, row[i]}];
        if (i > 0) ++follows[{row[i - 1], row[i]}];
      }
      CHECK(latin_row(n, participant + rows) == row);
    }
    CAPTURE(n);
    for (const auto& [at, count] : in_place) CHECK(count == static_cast<int>(rows / n));
    if (n > 1) CHECK(follows.size() == n * (n - 1));
    for (const auto& [pair, count] : follows) CHECK(count == static_cast<int>(rows / n));
  }
}

TEST_CASE("the reference is first in half of the pairs, and never by a pattern") {
  int first = 0, changes = 0;
  for (std::size_t trial = 0; trial < 2000; ++trial) {
    first += reference_first(9, 1, trial);
    changes += reference_first(9, 1, trial) != reference_first(9, 1, trial + 1);
  }
  CHECK(std::abs(first - 1000) < 70);
  CHECK(std::abs(changes - 1000) < 70);
  int differs = 0;
  for (std::size_t trial = 0; trial < 200; ++trial)
    differs += reference_first(9, 1, trial) != reference_first(10, 1, trial);
  CHECK(std::abs(differs - 100) < 40);
}

TEST_CASE("each run has every object shaded and unshaded once, in an order of its own") {
  const Identification design = paper_design();
  const auto trials = object_trials(design, 7, 3);
  REQUIRE(trials.size() == 8 * 14);
  std::set<std::vector<std::size_t>> orders;
  for (std::size_t run = 0; run < 8; ++run) {
    std::set<std::pair<std::size_t, bool>> seen;
    std::vector<std::size_t> order;
    for (std::size_t i = 14 * run; i < 14 * (run + 1); ++i) {
      seen.insert({trials[i].object, trials[i].shaded});
      order.push_back(trials[i].object);
      CHECK(trials[i].session == static_cast<int>(run / 4));
      CHECK(trials[i].block == static_cast<int>(run / 2 % 2));
      CHECK(trials[i].run == static_cast<int>(run % 2));
    }
    CHECK(seen.size() == 14);
    orders.insert(order);
  }
  CHECK(orders.size() == 8);
}

TEST_CASE("even participants begin with tactile feedback, odd ones without, in both sessions") {
  for (const std::uint64_t participant : {4u, 5u}) {
    for (const ObjectTrial& trial : object_trials(paper_design(), participant, 1))
      CHECK(trial.tactile == ((trial.block == 0) == (participant % 2 == 0)));
  }
}

TEST_CASE("cone and tetrahedron point both ways under every condition of a session, the others one way") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::map<std::tuple<int, std::size_t, bool, bool>, int> left;
    for (const ObjectTrial& trial : object_trials(paper_design(), 2, seed))
      left[{trial.session, trial.object, trial.shaded, trial.tactile}] += trial.facing == Facing::left;
    for (const auto& [key, count] : left) {
      const std::size_t object = std::get<1>(key);
      CHECK(count == (object == 0 || object == 4 ? 1 : 0));
    }
  }
}

TEST_CASE("a participant's number is what the name ends with") {
  CHECK(participant_number("7") == 7u);
  CHECK(participant_number("sub-012") == 12u);
  CHECK_FALSE(participant_number("anna"));
  CHECK_FALSE(participant_number(""));
  CHECK_FALSE(participant_number("99999999999999999999999"));
}

}  // namespace
}  // namespace tangent::experiment
