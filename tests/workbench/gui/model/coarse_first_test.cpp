#include "workbench/gui/model/coarse_first.h"

#include <doctest/doctest.h>

#include <set>

using namespace tangent;

TEST_CASE("a grid's cells come each once, coarse before fine, whatever its size") {
  for (const auto& [columns, rows] :
       {std::pair<std::size_t, std::size_t>{17, 17}, {13, 9}, {100, 1}, {1, 1}, {3, 40}}) {
    const std::vector<std::size_t> order = coarse_first(columns, rows);
    CHECK(order.size() == columns * rows);
    CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == order.size());
    std::size_t before = kCoarsest;
    for (const std::size_t cell : order) {
      const std::size_t step = coarse_step(cell % columns, cell / columns);
      CHECK(step <= before);
      before = step;
    }
  }
  CHECK(coarse_first(17, 17)[1] == 8);
  CHECK(coarse_step(0, 0) == 8);
  CHECK(coarse_step(4, 8) == 4);
  CHECK(coarse_step(3, 8) == 1);
}
