// What a plug-in may do wrong while it is felt, tick by tick: zero force within two ticks.
#include "tests/devices/plugin/plugin_faults.h"
#include "tests/support/approx.h"

#include <cstdio>

using namespace tangent;
using namespace tangent::testing;
using tangent::test::approx;

TEST_CASE("whatever a plug-in does wrong, there is no force within two ticks, and a person has to arm again") {
  for (const PluginFault& fault : kPluginFaults) {
    if (!can_be_tried(fault)) continue;
    CAPTURE(fault.name);
    const auto bench = bench_with(fault);
    CHECK_FALSE(bench->faulted());
    const PluginFaultTicks ticks = count_fault_ticks(*bench);
    CHECK(ticks.to_zero_force >= 1);  // the tick that it happens in
    CHECK(ticks.to_zero_force <= 2);
    CHECK(ticks.to_notice >= 1);
    CHECK(ticks.to_notice <= 12);  // the gate's 10 ms where nothing but silence is seen
    CHECK(bench->gate.state() == GateState::faulted);
    if (fault.as == DeviceFault::none) continue;
    CHECK(ticks.to_notice == 1);
    CHECK(bench->sample.state == DeviceState::faulted);
    CHECK(bench->sample.fault == fault.as);
    CHECK(bench->problem() != "");
  }
}

TEST_CASE("measure: faults of plugin" * doctest::skip()) {
  std::puts("| fault | ticks to notice | ticks to zero force |\n|---|---|---|");
  for (const PluginFault& fault : kPluginFaults) {
    if (!can_be_tried(fault)) continue;
    const PluginFaultTicks ticks = count_fault_ticks(*bench_with(fault));
    std::printf("| %s | %d | %d |\n", fault.name, ticks.to_notice, ticks.to_zero_force);
  }
}

TEST_CASE("a fault of a plug-in says what it is, where and what to do") {
  const auto problem = [](const char* fault) {
    PluginBench bench(patient_plugin(fault, 100));
    bench.arm();
    bench.step(100);
    std::string said;
    CHECK(in_the_end([&] { return !(said = bench.problem()).empty(); }));
    return said;
  };
  CHECK_MESSAGE(contains(problem("allocates"), "allocated memory; allocate in open instead"), problem("allocates"));
  CHECK_MESSAGE(contains(problem("lost"), "exchange failed: the cable is out; plug it in again"), problem("lost"));
  CHECK_MESSAGE(contains(problem("nan"), "not finite"), problem("nan"));
  CHECK_MESSAGE(contains(problem("backwards"), "time runs backwards"), problem("backwards"));
}

TEST_CASE("a plug-in that was garbled once goes on when a person has cleared it") {
  for (const char* fault : {"nan", "backwards", "lost", "allocates"}) {
    CAPTURE(fault);
    PluginOptions options = patient_plugin(fault, 100);
    options.settings.back().second = "1";  // for one tick
    PluginBench bench(options);
    bench.arm();
    while (bench.tick < 101) bench.step();
    CHECK(bench.sample.state == DeviceState::faulted);
    bench.step(20);
    CHECK(bench.sample.state == DeviceState::faulted);  // latched
    bench.step(DeviceRequest::clear_fault);
    bench.step();
    CHECK(bench.sample.state == DeviceState::ready);
    CHECK_FALSE(bench.pushes());  // the gate is still stopped
    bench.arm();
    CHECK(bench.problem().empty());
  }
}

TEST_CASE("a plug-in whose process dies is started again, and nothing arms by itself") {
  for (const char* fault : {"crash", "exit", "killed"}) {
    CAPTURE(fault);
    PluginOptions options = patient_plugin(fault, 100);
    options.settings.back().second = "1";
    PluginBench bench(options);
    bench.arm();
    while (bench.tick < 101) bench.step();
    CHECK(bench.sample.fault == DeviceFault::disconnected);
    LinkReport report;
    CHECK(in_the_end([&] {
      bench.device.report(report);
      return report.connects >= 2 && report.connected;
    }));
    bench.step(10);
    CHECK(bench.sample.state == DeviceState::faulted);
    CHECK_FALSE(bench.pushes());
    bench.step(DeviceRequest::clear_fault);
    bench.step(5);
    CHECK(bench.sample.state == DeviceState::ready);
    CHECK_FALSE(bench.pushes());
    bench.arm();
  }
}

TEST_CASE("a plug-in that crashes in exchange has its stop called first") {
  const TempFolder folder;
  PluginOptions options = patient_plugin("crash", 100);
  options.settings.emplace_back("log", folder.file("log"));
  options.restart_s = kForever_s;
  PluginBench bench(options);
  bench.arm();
  while (bench.tick < 101) bench.step();
  CHECK(bench.sample.fault == DeviceFault::disconnected);
  CHECK(read_text(folder.file("log")) == "open stop ");
  CHECK(in_the_end([&] { return !bench.problem().empty(); }));
  CHECK_MESSAGE(contains(bench.problem(), "ended by signal 6 (Aborted), in exchange"), bench.problem());
}

TEST_CASE("a plug-in that hangs in exchange is told to stop by another thread") {
  const TempFolder folder;
  PluginOptions options = patient_plugin("hang", 100);
  options.settings.emplace_back("log", folder.file("log"));
  options.hang_s = 0.01;
  options.end_s = 0.0;
  PluginBench bench(options);
  while (bench.tick < 100) bench.step();
  bench.device.wait_at_most(0.0);
  bench.step();
  CHECK(in_the_end([&] { return contains(read_text(folder.file("log")), "open stop "); }));
}

TEST_CASE("a plug-in that hangs is killed and started again") {
  PluginOptions options = patient_plugin("hang", 100);
  options.settings[2].second = "1";
  options.kill_s = 0.1;
  PluginBench bench(options);
  while (bench.tick < 100) bench.step();
  LinkReport before, after;
  bench.device.report(before);
  bench.device.wait_at_most(0.0);
  bench.step();  // one command, which the next would replace
  CHECK(in_the_end([&] {
    bench.device.report(after);
    return after.connects > before.connects && after.connected;
  }));
  bench.device.wait_at_most(kForever_s);
  CHECK(in_the_end([&] {
    bench.step(DeviceRequest::clear_fault);
    return bench.sample.state == DeviceState::ready;
  }));
}

TEST_CASE("silence shorter than the gate's 10 ms fades the force in again, and longer silence ends it") {
  PluginOptions options = patient_plugin("stuck", 100);
  options.settings.back().second = "5";
  PluginBench bench(options);
  bench.arm();
  while (bench.tick < 104) bench.step();
  CHECK_FALSE(bench.pushes());
  CHECK(bench.sample.age_s == approx(4e-3));
  CHECK(bench.sample.state == DeviceState::ready);
  bench.step(2);
  CHECK(bench.sample.age_s == 0.0);
  bench.step();
  CHECK(bench.pushes());
  CHECK(bench.device.sent_n().z < 0.1);
  bench.step(60);
  CHECK(bench.device.sent_n().z == approx(1.0));
}
