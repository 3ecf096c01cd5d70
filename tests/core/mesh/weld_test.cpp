#include "core/mesh/weld.h"

#include <doctest/doctest.h>

#include <map>
#include <random>

using namespace tangent;

TEST_CASE("weld numbers groups by first appearance and leaves out what is not finite or too large") {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> v{{1, 2, 3},   {0, 0, 0},   {1, 2, 3},   {-0.0, 0, -0.0},
                            {NAN, 0, 0}, {0, inf, 0}, {0, 0, 101}, {1, 2, 3.0000000000000004}};
  const Weld w = weld_exact(v, 100.0);
  CHECK(w.id == std::vector<std::uint32_t>{0, 1, 0, 1, kNone, kNone, kNone, 2});
  CHECK(w.first == std::vector<std::uint32_t>{0, 1, 7});
  CHECK(weld_exact({}, 1.0).count() == 0);
}

TEST_CASE("weld agrees with a map on many vectors of a lattice") {
  std::mt19937 random(7);
  std::vector<Vec3> v;
  for (int i = 0; i < 50000; ++i) v.push_back(Vec3(random() % 30, random() % 30, random() % 30) * 0.001);
  const Weld w = weld_exact(v, 1.0);
  std::map<std::array<double, 3>, std::uint32_t> expected;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto [it, added] =
        expected.try_emplace({v[i].x, v[i].y, v[i].z}, static_cast<std::uint32_t>(expected.size()));
    wrong += w.id[i] != it->second;
    if (added) wrong += w.first[it->second] != i;
  }
  CHECK(wrong == 0);
}
