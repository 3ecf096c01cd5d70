// What a plug-in may take from the machine: memory, and the processor at real-time priority.
#include "tests/devices/plugin/plugin_faults.h"

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

using namespace tangent;
using namespace tangent::testing;

namespace {

constexpr const char* kWhat = "after it got no more memory than its 64 MB";
constexpr const char* kRemedy = "let it have more: --plugin-memory-mb MB";

bool skipped() {
  if (!kMemoryCanEnd) MESSAGE("skipped: a sanitizer needs memory itself to say that there is none");
  return !kMemoryCanEnd;
}

void check_said(const std::string& problem) {
  CHECK_MESSAGE(contains(problem, kWhat), problem);
  CHECK_MESSAGE(contains(problem, kRemedy), problem);
}

std::string problem_in_the_end(const PluginBench& bench) {
  std::string said;
  CHECK(in_the_end([&] { return !(said = bench.problem()).empty(); }));
  return said;
}

/// The most memory that a process that lives had at once, MB.
double most_mb(const std::string& process) {
  const std::string status = read_text("/proc/" + process + "/status");
  const std::size_t line = status.find("VmHWM:");
  REQUIRE(line != std::string::npos);
  return 1.024e-3 * std::strtod(status.c_str() + line + 6, nullptr);
}

PluginOptions limited(const std::string& fault, std::uint64_t at) {
  PluginOptions options = patient_plugin(fault, at);
  options.memory_mb = kTestMemory_mb;
  return options;
}

/// Whether a process may ask for it.
bool may_have_realtime() {
  const pid_t child = ::fork();
  if (child == 0) {
    sched_param priority{};
    priority.sched_priority = 1;
    ::_exit(::sched_setscheduler(0, SCHED_FIFO, &priority) == 0 ? 0 : 1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  return status == 0;
}

}  // namespace

TEST_CASE("a plug-in that allocates without end gets its limit and no more, and says so") {
  if (skipped()) return;
  const TempFolder folder;
  PluginOptions options = limited("allocates all", 100);
  options.settings.emplace_back("log", folder.file("log"));
  PluginBench bench(options);
  bench.arm();
  while (bench.tick < 101) bench.step();
  CHECK(bench.sample.state == DeviceState::faulted);
  bench.step();
  CHECK_FALSE(bench.pushes());
  check_said(problem_in_the_end(bench));
  const std::string log = read_text(folder.file("log"));  // "open 123 stop "
  const double mb = most_mb(log.substr(5, log.find(' ', 5) - 5));
  CHECK(mb > 0.9 * kTestMemory_mb);
  CHECK(mb < kTestMemory_mb + 32.0);  // and the libraries that every process has
  bench.step(DeviceRequest::clear_fault);
  bench.step();
  CHECK(bench.sample.state == DeviceState::faulted);  // it goes on with it
}

TEST_CASE("a plug-in that leaks in a thread of its own dies of it, and is started again") {
  if (skipped()) return;
  const TempFolder folder;
  PluginOptions options = limited("leaks", 100);
  options.settings[2].second = "1";
  options.settings.emplace_back("log", folder.file("log"));
  PluginBench bench(options);
  bench.arm();
  const std::uint32_t connects = [&] {
    LinkReport report;
    bench.device.report(report);
    return static_cast<std::uint32_t>(report.connects);
  }();
  std::string said;
  CHECK(in_the_end([&] {
    bench.step();
    if (said.empty()) said = bench.problem();
    return bench.sample.state == DeviceState::faulted;
  }));
  CHECK(bench.sample.fault == DeviceFault::disconnected);
  bench.step();
  CHECK_FALSE(bench.pushes());
  CHECK(contains(read_text(folder.file("log")), "open stop "));
  LinkReport report;
  CHECK(in_the_end([&] {
    if (said.empty()) said = bench.problem();
    bench.device.report(report);
    return report.connects > connects && report.connected;
  }));
  if (!said.empty()) check_said(said);
  CHECK(in_the_end([&] {
    bench.step(DeviceRequest::clear_fault);
    return bench.sample.state == DeviceState::ready;
  }));
  bench.arm();
}

TEST_CASE("a plug-in that needs more memory than its limit says so in open, and works with a higher one or with none") {
  if (skipped()) return;
  const auto opened = [](double memory_mb) {
    PluginOptions options = patient_plugin();
    options.settings = {{"hoard", "100"}};
    options.memory_mb = memory_mb;
    PluginForceDevice device(options);
    return device.open();
  };
  const Status refused = opened(kTestMemory_mb);
  REQUIRE_FALSE(refused);
  check_said(refused.error().message());
  CHECK_MESSAGE(contains(refused.error().message(), "no room for the pictures"), refused.error().message());
  CHECK(opened(200.0));
  CHECK(opened(0.0));
}

TEST_CASE("a plug-in that loops in exchange at real-time priority is ended, and its device stopped first") {
  if (!may_have_realtime()) {
    MESSAGE("skipped: this user may not have real-time priority");
    return;
  }
  const TempFolder folder;
  PluginOptions options = patient_plugin("spins", 100);  // and after: only the last of three commands may come through
  options.settings.emplace_back("log", folder.file("log"));
  options.realtime = true;
  options.hang_s = 0.01;
  options.end_s = 0.0;
  options.restart_s = kForever_s;
  PluginBench bench(options);
  bench.arm();
  while (bench.tick < 100) bench.step();
  bench.device.wait_at_most(0.0);
  bench.step(3);
  CHECK_FALSE(bench.pushes());
  const std::string said = problem_in_the_end(bench);
  CHECK(contains(read_text(folder.file("log")), "open stop "));
  std::string last = said;
  CHECK(in_the_end([&] { return contains(last = bench.problem(), "ended by signal 24"); }));
  CHECK_MESSAGE(contains(last, "exchange must not loop"), last);
}
