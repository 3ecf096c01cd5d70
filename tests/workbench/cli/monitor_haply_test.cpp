// The program and an emulated Inverse Service, end to end.
#include "tests/devices/haply/haply_service.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/process.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::testing;

TEST_CASE("monitor drives a Haply Inverse3 through its service, and leaves it without force") {
  HaplyService service;
  ProcessResult r;
  const auto driven = [&] { return service.forces() > 100; };
  for (int i = 0; i < 20 && !driven(); ++i) {  // the service of a slow machine may answer too late to be opened
    const Process process({"monitor", "--force", "haply", "--display", "none", "--haply-address", service.address(),
                           "--arm", "--without-timeout"});
    CHECK(emulation::eventually([&] { return driven() || process.ended(); }, 120.0));
    process.interrupt(SIGINT);
    r = process.wait();
  }
  REQUIRE(driven());
  CHECK(r.exit_code == 0);
  CHECK(r.out.find("Tick to tick:") != std::string::npos);
  CHECK(emulation::eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0));
  CHECK(emulation::eventually([&] { return service.closed_politely(); }, 60.0));
}

TEST_CASE("monitor says what is the matter with a Haply service that is missing, far away or crowded") {
  HaplyService service({.devices = {"049D", "04BA"}});
  // A slow machine's service may first be said to be silent.
  const auto says = [](const std::string& address, const char* what) {
    std::string err;
    for (int i = 0; i < 20 && err.find(what) == std::string::npos; ++i) {
      const ProcessResult r = run_workbench(
          {"monitor", "--seconds", "0.2", "--force", "haply", "--display", "none", "--haply-address", address});
      CHECK(r.exit_code == 1);
      err = r.err;
    }
    CHECK_MESSAGE(err.find(what) != std::string::npos, err);
  };
  says(service.address(), "--haply-device");
  says("ws://198.51.100.1:10001", "--haply-other-host");
  service.go_away();
  says(service.address(), "start Haply Hub");
}
