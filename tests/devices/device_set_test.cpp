#include "devices/device_set.h"
#include "devices/found_device.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("any force device goes with any contact display, and each says what it can do") {
  for (const std::string& force : force_device_names()) {
    for (const std::string& display : contact_display_names()) {
      CAPTURE(force);
      CAPTURE(display);
      const auto set = make_devices({force, display});
      REQUIRE(set);
      CHECK((set->force == nullptr) == (force == "none"));
      CHECK((set->display == nullptr) == (display == "none"));
      if (set->force) {
        const ForceCapabilities& can = set->force->capabilities();
        CHECK(can.simulated == are_simulated({force, "none"}));
        CHECK((set->force->hand() != nullptr) == can.simulated);
        CHECK(set->force->calls_us() == (force == "scheduled" || force == "openhaptics"));
        if (can.simulated) {  // of a real one some of it is known only when it is open
          CHECK(can.peak_force_n == 8.5);
          CHECK(can.position_resolution_m == (force == "ideal" ? 0.0 : 0.03e-3));
        }
      }
      if (set->display) CHECK(set->display->capabilities().travel_m == approx(0.02));
    }
  }
}

TEST_CASE("one name stands for both devices") {
  CHECK(*devices_by_one_name("simulated") == DeviceNames{"simulated", "simulated"});
  CHECK(*devices_by_one_name("ideal") == DeviceNames{"ideal", "ideal"});
  CHECK(*devices_by_one_name("cld") == DeviceNames{"simulated", "cld"});
  CHECK(*devices_by_one_name("maestro") == DeviceNames{"simulated", "maestro"});
  CHECK(*devices_by_one_name("none") == DeviceNames{"none", "none"});
  CHECK(to_string(DeviceNames{"ideal", "ideal"}) == "ideal");
  CHECK(to_string(DeviceNames{"ideal", "cld"}) == "ideal and cld");
}

TEST_CASE("an unknown device is refused with the choices and the option it came from") {
  const auto one = devices_by_one_name("phantom");
  REQUIRE_FALSE(one);
  CHECK(one.error().remedy == "choose simulated, ideal, cld, maestro or none");
  const auto force = make_devices({"cld", "simulated"});
  REQUIRE_FALSE(force);
  CHECK(force.error().where == "--force");
  CHECK(force.error().remedy ==
        "choose simulated, ideal, scheduled, tilt, falcon, serial, plugin, openhaptics, dhd, haply or none");
  const auto display = make_devices({"simulated", "phantom"});
  REQUIRE_FALSE(display);
  CHECK(display.error().where == "--display");
  CHECK(display.error().remedy == "choose simulated, ideal, cld, maestro or none");
}

TEST_CASE("what is set up for OpenHaptics is listed where its library is, and not taken for attached") {
  const testing::TempFolder setups;
  DeviceOptions options;
  options.vendor.hd.library = testing::stub_hd();
  options.vendor.hd.configs = setups.path();
  options.vendor.dhd.library = "/nowhere";
  options.serial.dev = setups.path();
  options.haply.address = "http://localhost";
  const auto listed = [&] {
    std::vector<FoundDevice> all = find_force_devices(options);
    all.erase(std::remove_if(all.begin(), all.end(), [](const FoundDevice& d) { return d.kind != "openhaptics"; }),
              all.end());
    return all;
  };
  REQUIRE(listed().size() == 1);
  CHECK(listed().front().problem.what == "its library is there, and no device is set up");
  for (const char* name : {"Left.config", "Right.config"}) std::ofstream(setups.path() / name) << "";
  REQUIRE(listed().size() == 2);
  CHECK(listed().front().name == "Left");
  CHECK(listed().front().can_be_opened());
  CHECK_FALSE(listed().front().attached);
  CHECK_FALSE(is_attached("openhaptics", options));
  CHECK_FALSE(is_attached("dhd", options));
  CHECK_FALSE(is_attached("simulated", options));
  options.vendor.hd.library = "/nowhere";
  CHECK(listed().front().problem.what.find("can't be loaded") != std::string::npos);
}

TEST_CASE("every force device that is looked for says what is there, or what keeps it from being seen") {
  CHECK(sought_force_devices() == std::vector<std::string>{"falcon", "serial", "openhaptics", "dhd", "haply"});
  const testing::TempFolder folder;
  std::filesystem::create_directories(folder.file("dev"));
  folder.write("dev/ttyACM0", "");
  DeviceOptions options;
  options.serial.dev = folder.file("dev");
  options.vendor.dhd.library = folder.file("libdhd.so");  // is not there
  options.vendor.hd.library = folder.file("libHD.so");
  options.haply.address = "http://localhost";  // no address of a service
  options.falcon.link.match.vendor = 0xfffe;   // nobody has it: a Falcon may be attached
  std::map<std::string, int> listed;
  for (const FoundDevice& found : find_force_devices(options)) {
    CAPTURE(found.kind);
    ++listed[found.kind];
    if (found.kind == "serial") {
      CHECK(found.name.find("ttyACM0") != std::string::npos);
    } else {  // of falcon: no libusb, or no USB at all
      CHECK(found.name.empty());
      CHECK_FALSE(found.can_be_opened());
      CHECK_FALSE(found.problem.remedy.empty());
    }
  }
  for (const char* kind : {"serial", "openhaptics", "dhd", "haply"}) CHECK(listed[kind] == 1);
}
