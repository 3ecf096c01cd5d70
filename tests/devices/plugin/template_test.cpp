// The template of a plug-in, built outside of this project as a reader of devices/plugin/README.md would.
#include "tests/devices/plugin/plugin_bench.h"
#include "tests/support/paths.h"

#include <cstdlib>
#include <filesystem>

using namespace tangent;
using namespace tangent::testing;

namespace {

const std::filesystem::path kPluginFolder = std::filesystem::path(testing::source_folder()) / "devices/plugin";

bool runs(const TempFolder& folder, const std::string& command) {
  const int code = std::system(("cd " + folder.path().string() + " && (" + command + ") >said 2>&1").c_str());
  CHECK_MESSAGE(code == 0, read_text(folder.file("said")));
  return code == 0;
}

/// A folder of somebody else: the template and the header.
void copy_template(const TempFolder& folder) {
  for (const char* file : {"template/my_device.c", "template/CMakeLists.txt", "tangent_device.h"})
    std::filesystem::copy(kPluginFolder / file, folder.path());
}

}  // namespace

TEST_CASE("the template of a plug-in builds outside the project by one command, and is pushed where the force points") {
  const TempFolder folder;
  copy_template(folder);
  REQUIRE(
      runs(folder, "cc -std=c11 -O2 -Wall -Wextra -Wpedantic -Werror -shared -fPIC -I. my_device.c -o my_device.so"));
  for (const bool within : {false, true}) {
    CAPTURE(within);
    PluginOptions options = patient_plugin();
    options.path = folder.file("my_device.so");
    options.settings = {{"serial", "7"}};
    options.in_process = within;
    PluginBench bench(options);
    CHECK(bench.device.capabilities().name == "my device");
    CHECK(bench.device.capabilities().serial == "7");
    bench.arm();
    const double before_m = bench.sample.position_m.z;
    bench.step(20);
    CHECK(bench.sample.position_m.z > before_m + 1e-4);
    CHECK(bench.sample.state == DeviceState::ready);
    CHECK(bench.problem().empty());
  }
}

TEST_CASE("the template of a plug-in builds as a project of its own") {
  const TempFolder folder;
  copy_template(folder);
  REQUIRE(runs(folder, "cmake -DTANGENT_INCLUDE=. -B build . && cmake --build build"));
  PluginOptions options = patient_plugin();
  options.path = folder.file("build/my_device.so");
  PluginForceDevice device(options);
  CHECK(device.open());
}
