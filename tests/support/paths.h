// Where tests find what they read, start and load. Known to paths.cpp alone: every other object of the tests is the
// same wherever the project lies, so that a compiler cache serves fresh clones, too.
#pragma once

#include <string>

namespace tangent::testing {

std::string source_folder();  ///< of the project
std::string test_assets();    ///< tests/assets
std::string shared_assets();  ///< larger meshes and paths; may not be there (tests/README.md)
std::string program();        ///< workbench

std::string plugin_host();    ///< the process that plug-ins run in
std::string faulty_plugin();  ///< devices/plugin/faulty_plugin.cpp
/// Stand-ins for makers' libraries, and each with functions that are missing.
std::string stub_hd();
std::string lacking_hd();
std::string stub_dhd();
std::string lacking_dhd();

}  // namespace tangent::testing
