// The program and an emulated Inverse Service, end to end.
#include "tests/devices/haply/haply_service.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/process.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::testing;

TEST_CASE("monitor drives a Haply Inverse3 through its service, and leaves it without force") {
  HaplyService service;
  const Process process({"monitor", "--force", "haply", "--display", "none", "--haply-address", service.address(),
                         "--arm", "--without-timeout"});
  CHECK(emulation::eventually([&] { return service.forces() > 100; }, 60.0));
  process.interrupt(SIGINT);
  const ProcessResult r = process.wait();
  CHECK(r.exit_code == 0);
  CHECK(r.out.find("Tick to tick:") != std::string::npos);
  CHECK(service.force_n() == Vec3(0.0));
  CHECK(emulation::eventually([&] { return service.closed_politely(); }, 60.0));
}

TEST_CASE("monitor says what is the matter with a Haply service that is missing, far away or crowded") {
  HaplyService service({.devices = {"049D", "04BA"}});
  const auto run = [](const std::vector<std::string>& more) {
    std::vector<std::string> all{"monitor", "--seconds", "0.2", "--force", "haply", "--display", "none"};
    all.insert(all.end(), more.begin(), more.end());
    const ProcessResult r = run_workbench(all);
    CHECK(r.exit_code == 1);
    return r.err;
  };
  CHECK(run({"--haply-address", service.address()}).find("--haply-device") != std::string::npos);
  CHECK(run({"--haply-address", "ws://198.51.100.1:10001"}).find("--haply-other-host") != std::string::npos);
  service.go_away();
  CHECK(run({"--haply-address", service.address()}).find("start Haply Hub") != std::string::npos);
}
