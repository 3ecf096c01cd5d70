#include "workbench/gui/widgets/nearest_names.h"

#include <doctest/doctest.h>

#include <array>

using namespace tangent;

TEST_CASE("the nearest names come first, whatever the case, blanks, and what stands before the dot") {
  constexpr std::array<std::string_view, 5> kNames{"solver.gain_curvature_m", "solver.gain_overall",
                                                   "solver.tolerance_m", "finger.radius_m", "force.stiffness_n_per_m"};
  CHECK(nearest_names("gain_curvatur_m", kNames).front() == "solver.gain_curvature_m");
  CHECK(nearest_names("Gain Overall", kNames).front() == "solver.gain_overall");
  CHECK(nearest_names("radius", kNames).front() == "finger.radius_m");
  CHECK(nearest_names("tolerence", kNames).front() == "solver.tolerance_m");
  CHECK(nearest_names("force.stifness_n_per_m", kNames).front() == "force.stiffness_n_per_m");
  CHECK(nearest_names("nonsense", kNames).size() == 3);
  CHECK(nearest_names("", kNames, 9).size() == kNames.size());
  CHECK(nearest_text("radius", {}).empty());
  CHECK(nearest_text("radius_m", kNames).starts_with("nearest: finger.radius_m, "));
}
