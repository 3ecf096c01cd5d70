#include "tests/support/process.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

using namespace tangent::testing;

namespace {

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("monitor shows the simulated devices, a fault injected by name, and the log of it") {
  const ProcessResult r = run_workbench({"monitor", "--seconds", "2", "--inject", "drop-out"});
  CHECK(r.exit_code == 0);
  CHECK(has(r.out, "force device ready"));
  CHECK(has(r.out, "safety gate: armed"));
  CHECK(has(r.out, "force device: disconnected"));
  CHECK(has(r.out, "safety gate: force device not ready"));
  CHECK(has(r.out, "Tick to tick:"));
}

TEST_CASE("monitor arms simulated devices, and none that are to stay stopped - it says so, and what it got") {
  const ProcessResult armed = run_workbench({"monitor", "--seconds", "2"});
  CHECK(armed.exit_code == 0);
  CHECK(has(armed.out, "safety gate: armed"));
  const ProcessResult stopped = run_workbench({"monitor", "--seconds", "1", "--stay-stopped"});
  CHECK(stopped.exit_code == 0);
  CHECK_FALSE(has(stopped.out, "safety gate: armed"));
  CHECK(has(stopped.out, "| No force: "));
  CHECK(has(stopped.out, "SCHED_FIFO"));
  const bool granted = has(stopped.out, "SCHED_FIFO 40, memory locked");
  CHECK(granted != has(stopped.out, "60-tangent-workbench-limits.conf"));
}

TEST_CASE("monitor says why an armed device gives no force outside its workspace") {
  const ProcessResult r = run_workbench({"monitor", "--seconds", "3", "--place-offset-mm", "190", "0", "0"});
  CHECK(r.exit_code == 0);
  CHECK(has(r.out, "gate armed | No force: the finger is outside the device's workspace | "));
}

TEST_CASE("a signal ends the monitor in order, with its report") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    CAPTURE(signal);
    const Process process({"monitor"});
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    process.interrupt(signal);
    const ProcessResult r = process.wait();
    CHECK(r.exit_code == 0);
    CHECK(has(r.out, "Tick to tick:"));
    CHECK(has(r.out, "\nLog\n"));
  }
}

TEST_CASE("monitor places the scene as asked, and refuses what can't be") {
  const std::vector<std::string> short_run{"monitor", "--seconds", "0.5"};
  const auto with = [&short_run](const std::vector<std::string>& more) {
    std::vector<std::string> all = short_run;
    all.insert(all.end(), more.begin(), more.end());
    return run_workbench(all);
  };
  const ProcessResult placed =
      with({"--place-scale", "0.5", "--place-offset-mm", "1", "-2.5", "3", "--place-rotate-deg", "0", "-90", "45"});
  CHECK(placed.exit_code == 0);
  CHECK(has(placed.out, "Scene on the device: scale 0.5, the device at 1.00 -2.50 3.00 mm, turned by"));
  const ProcessResult fitted = with({"--place-fit"});
  CHECK(fitted.exit_code == 0);
  CHECK_FALSE(has(fitted.out, "scale 1,"));
  const std::vector<std::vector<std::string>> wrong{{"--place-scale", "0"},
                                                    {"--place-scale", "nan"},
                                                    {"--place-scale", "1e4"},
                                                    {"--place-offset-mm", "1", "inf", "0"},
                                                    {"--place-offset-mm", "1", "2"},
                                                    {"--place-rotate-deg", "1", "x", "0"},
                                                    {"--place-fit", "--place-scale", "2"}};
  for (const auto& options : wrong) {
    CAPTURE(options.back());
    const ProcessResult r = with(options);
    CHECK(r.exit_code == 2);
    CHECK(has(r.err, "--place-"));
  }
}

TEST_CASE("monitor says once what to do about a device that was never there") {
  const ProcessResult r = run_workbench({"monitor", "--seconds", "0.2", "--device", "cld"});
  CHECK(r.exit_code == 1);
  const std::string said = r.err.substr(std::min(r.err.size(), r.err.find("was not there at any time")));
  CHECK(has(said, "see workbench devices"));
  CHECK(said.find("plug it in") == said.rfind("plug it in"));
}

TEST_CASE("monitor refuses unknown faults and devices, naming the choices") {
  const ProcessResult fault = run_workbench({"monitor", "--seconds", "1", "--inject", "gremlins"});
  CHECK(fault.exit_code == 2);
  CHECK(has(fault.err, "stuck-encoder"));
  const ProcessResult device = run_workbench({"monitor", "--seconds", "1", "--device", "phantom"});
  CHECK(device.exit_code == 2);
  CHECK(has(device.err, "maestro"));
  const ProcessResult force = run_workbench({"monitor", "--seconds", "1", "--force", "cld"});
  CHECK(force.exit_code == 2);
  CHECK(has(force.err, "ideal"));
  CHECK(run_workbench({"monitor", "--seconds", "x"}).exit_code == 2);
  const ProcessResult both = run_workbench({"monitor", "--seconds", "1", "--arm", "--stay-stopped"});
  CHECK(both.exit_code == 2);
  CHECK(has(both.err, "--stay-stopped"));
}

TEST_CASE("a log of packets that can't be written ends the monitor before anything moves") {
  const ProcessResult r = run_workbench({"monitor", "--seconds", "1", "--packets", "/dev/full"});
  CHECK(r.exit_code == 1);
  CHECK(has(r.err, "/dev/full"));
  CHECK_FALSE(has(r.out, "armed"));
}

TEST_CASE("the monitor says what of the preset the device does not render") {
  const ProcessResult r = run_workbench({"monitor", "--seconds", "1", "--place-scale", "10"});
  CHECK(r.exit_code == 0);
  CHECK(has(r.err, "the stiffness of 800 N/m is more than"));
  CHECK(has(r.err, "it uses 350 N/m"));
  CHECK_FALSE(has(run_workbench({"monitor", "--seconds", "1"}).err, "stiffness"));
}

TEST_CASE("force device and display are chosen apart, whatever --device says") {
  const ProcessResult r =
      run_workbench({"monitor", "--seconds", "1", "--display", "none", "--force", "ideal", "--device", "simulated"});
  CHECK(r.exit_code == 0);
  CHECK(has(r.out, "force device ready"));
  CHECK(has(r.out, "display absent"));
  CHECK_FALSE(has(r.out, "display ready"));
}

TEST_CASE("devices lists the simulated ones everywhere") {
  const ProcessResult r = run_workbench({"devices"});
  CHECK(r.exit_code == 0);
  CHECK(has(r.out, "peak 8.5 N, continuous 1.4 N"));
  CHECK(has(r.out, "simulated contact display"));
}

TEST_CASE("monitor records what it shows, and the file computes again to the same bits") {
  const TempFolder folder;
  const std::string file = folder.file("m.sqlite");
  const ProcessResult r = run_workbench({"monitor", "--seconds", "1", "--record", file});
  CHECK(r.exit_code == 0);
  CHECK(has(r.out, ", 0 missing, in "));
  const ProcessResult again = run_workbench({"replay", file});
  CHECK(again.exit_code == 0);
  CHECK(has(again.out, "The same bits."));
  const ProcessResult twice = run_workbench({"monitor", "--seconds", "1", "--record", file});
  CHECK(twice.exit_code == 1);
  CHECK(has(twice.err, "is there already"));
}
