#include "tests/support/paths.h"

namespace tangent::testing {

std::string source_folder() { return TANGENT_SOURCE_DIR; }
std::string test_assets() { return TANGENT_SOURCE_DIR "/tests/assets"; }
std::string shared_assets() { return TANGENT_SHARED_ASSETS; }
std::string program() { return TANGENT_WORKBENCH; }
std::string plugin_host() { return TANGENT_PLUGIN_HOST; }
std::string faulty_plugin() { return TANGENT_FAULTY_PLUGIN; }
std::string stub_hd() { return TANGENT_STUB_HD; }
std::string lacking_hd() { return TANGENT_LACKING_HD; }
std::string stub_dhd() { return TANGENT_STUB_DHD; }
std::string lacking_dhd() { return TANGENT_LACKING_DHD; }

}  // namespace tangent::testing
