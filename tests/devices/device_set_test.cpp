#include "devices/device_set.h"

#include <doctest/doctest.h>

using namespace tangent;

TEST_CASE("every named device set can be made, and says what it can do") {
  for (const std::string& name : device_set_names()) {
    const auto set = make_devices(name);
    REQUIRE(set);
    CHECK((set->force == nullptr) == (name == "none"));
    CHECK((set->display == nullptr) == (name == "none"));
    if (!set->force) continue;
    CHECK(set->force->capabilities().peak_force_n == 8.5);
    CHECK(set->force->hand() != nullptr);
    CHECK(set->display->capabilities().travel_m == doctest::Approx(0.02));
    CHECK(set->force->capabilities().position_resolution_m == (name == "ideal" ? 0.0 : 0.03e-3));
  }
}

TEST_CASE("an unknown device set is refused with the choices") {
  const auto set = make_devices("phantom");
  REQUIRE_FALSE(set);
  for (const std::string& name : device_set_names()) CHECK(set.error().remedy.find(name) != std::string::npos);
}
