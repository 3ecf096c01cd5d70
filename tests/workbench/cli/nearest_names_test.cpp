#include "workbench/cli/nearest_names.h"

#include <doctest/doctest.h>

#include <vector>

namespace tangent {
namespace {

TEST_CASE("the nearest names come first, each once") {
  const std::vector<std::string> names{"torus", "cube", "cube_rounded", "cone", "torus"};
  CHECK(nearest_names("cube", names, 1) == "cube");
  CHECK(nearest_names("cub", names, 2) == "cube or cone");
  CHECK(nearest_names("tours", names) == "torus, cube or cone");
  CHECK(nearest_names("x", {}) == "");
  CHECK(nearest_names("", names, 10) == "cube, cone, torus or cube_rounded");
}

}  // namespace
}  // namespace tangent
