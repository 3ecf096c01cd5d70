// Reads the 40-digit reference values of tests/assets/oracle.
#pragma once

#include "core/base/vec.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace tangent::test {

inline nlohmann::json read_oracle(const std::string& name) {
  std::ifstream file(testing::test_assets() + "/oracle/" + name);
  REQUIRE_MESSAGE(file.good(), "tests/assets/oracle/" << name << " is missing");
  return nlohmann::json::parse(file);
}

inline Vec3 vec3(const nlohmann::json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

}  // namespace tangent::test
