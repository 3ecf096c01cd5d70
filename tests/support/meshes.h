// Mesh and pose files for tests: those of tests/assets, which are always present, and larger ones in an optional folder
// (TANGENT_SHARED_ASSETS, see tests/README.md).
#pragma once

#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <initializer_list>
#include <string>

namespace tangent::testing {

/// spot, 5,856 triangles.
inline std::filesystem::path spot_file() { return std::filesystem::path(testing::test_assets()) / "meshes/spot.obj"; }

inline std::filesystem::path shared_file(const std::string& name) {
  return std::filesystem::path(testing::shared_assets()) / name;
}

/// Call first in a test case and return on false: ctest reports a case that printed this message as skipped, whatever
/// else it checked.
inline bool shared_files_there(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (std::filesystem::exists(shared_file(name))) continue;
    MESSAGE("skipped: no " << shared_file(name).string());
    return false;
  }
  return true;
}

}  // namespace tangent::testing
