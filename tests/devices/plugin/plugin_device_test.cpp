// A plug-in loaded, driven and closed; and what can't be loaded.
#include "devices/plugin/plugin_device.h"

#include "devices/device_set.h"
#include "devices/plugin/plugin_process.h"
#include "tests/devices/plugin/plugin_bench.h"
#include "tests/support/paths.h"

#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

using namespace tangent;
using namespace tangent::testing;

namespace {

constexpr bool kWithin[]{false, true};

std::string why_not(PluginOptions options) {
  PluginForceDevice device(std::move(options));
  const Status ok = device.open();
  CHECK_FALSE(ok);
  return ok ? std::string() : ok.error().message();
}

PluginOptions as_file(const std::string& path) {
  PluginOptions options = patient_plugin();
  options.path = path;
  return options;
}

/// The plug-in of the tests under another name, which makes it another plug-in.
std::string copy_as(const TempFolder& folder, const std::string& name) {
  std::filesystem::copy_file(testing::faulty_plugin(), folder.file(name));
  return folder.file(name);
}

}  // namespace

TEST_CASE("a plug-in is opened, says what it can do, answers every tick and is stopped before it is closed") {
  for (const bool within : kWithin) {
    CAPTURE(within);
    const TempFolder folder;
    PluginOptions options = patient_plugin();
    options.settings = {{"serial", "0042"}, {"log", folder.file("log")}};
    options.in_process = within;
    {
      PluginBench bench(options);
      bench.step();
      CHECK(bench.sample.state == DeviceState::ready);  // from the first tick on
      const ForceCapabilities& can = bench.device.capabilities();
      CHECK(can.name == "handle of the tests");
      CHECK(can.serial == "0042");
      CHECK(can.peak_force_n == 5.0);
      CHECK(can.firmware_timeout_s == 0.05);
      CHECK(can.apparent_mass_kg == 0.0);  // not known
      CHECK(can.buttons == 1);
      CHECK_FALSE(can.simulated);
      CHECK(can.workspace_half_size_m == Vec3(0.1));
      bench.arm();
      bench.step(20);
      CHECK(bench.sample.force_n == Vec3(0.0, 0.0, 1.0));
      CHECK(bench.sample.position_m == Vec3(0.01));
      CHECK(bench.sample.age_s == 0.0);
      LinkReport report;
      REQUIRE(bench.device.report(report));
      CHECK(report.connected);
      CHECK(report.problem.empty());
      CHECK(report.lost == 0);
      CHECK_FALSE(bench.device.open());  // already
      bench.device.close();
      bench.step();
      CHECK(bench.sample.state == DeviceState::absent);
      CHECK(read_text(folder.file("log")) == "open stop close ");
      REQUIRE(bench.device.open());
      bench.step(DeviceRequest::clear_fault);
      bench.arm();
    }
    CHECK(read_text(folder.file("log")) == "open stop close open stop close ");
  }
}

TEST_CASE("what is no plug-in is refused with what is wrong and what to do, in a process of its own and within") {
  const TempFolder folder;
  Dl_info libc{};
  REQUIRE(::dladdr(reinterpret_cast<void*>(&::fopen), &libc) != 0);
  std::string other = read_text(testing::faulty_plugin());
  const std::string cut = folder.write("cut.so", other.substr(0, 600));
  other[18] = 40;  // 32-bit ARM
  other[19] = 0;
  const std::string arm = folder.write("arm.so", other);
  REQUIRE(::mkfifo(folder.file("pipe.so").c_str(), 0600) == 0);
  const std::vector<std::pair<std::string, std::string>> wrong{
      {folder.file("none.so"), "there is no such file; give --plugin the path"},
      {folder.path().string(), "is a folder"},
      {folder.file("pipe.so"), "is no file; give --plugin the path"},
      {folder.write("text.so", "hello, this is a text of some length"), "is no shared library; compile the plug-in"},
      {folder.write("short.so", "x"), "is no shared library"},
      {arm, "is a library for 32-bit ARM, this program is for"},
      {cut, "is cut off: it has 600 bytes"},
      {testing::plugin_host(), "can't be loaded: "},
      {std::filesystem::canonical(libc.dli_fname).string(), "does not export tangent_device_entry"},
      {copy_as(folder, "old.so"), "is of version 0 of tangent_device.h"},
      {copy_as(folder, "small.so"), "with a table of 16 bytes"},
      {copy_as(folder, "refusing.so"), "can't work with version 1"},
      {copy_as(folder, "lacking.so"), "its table lacks a function"}};
  for (const bool within : kWithin) {
    for (const auto& [path, expected] : wrong) {
      CAPTURE(within);
      CAPTURE(path);
      PluginOptions options = as_file(path);
      options.in_process = within;
      const std::string said = why_not(options);
      CHECK_MESSAGE(contains(said, expected), said);
      CHECK_MESSAGE(contains(said, path), said);
    }
  }
  PluginForceDevice unnamed(as_file(""));
  const Status ok = unnamed.open();
  REQUIRE_FALSE(ok);
  CHECK(ok.error().message() == "--force plugin: no plug-in is named; name its shared library: --plugin PATH.so");
}

TEST_CASE("a plug-in that may not be read is refused") {
  if (::geteuid() == 0) {
    MESSAGE("skipped: root may read everything");
    return;
  }
  const TempFolder folder;
  const std::string path = copy_as(folder, "locked.so");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  CHECK(contains(why_not(as_file(path)), "may not be read; chmod a+r"));
}

TEST_CASE("a plug-in that fails or crashes before its first tick says so, and leaves this program alone") {
  const auto said = [](const char* fault) { return why_not(patient_plugin(fault)); };
  CHECK_MESSAGE(
      contains(said("capabilities fail"), "capabilities failed: the calibration is missing; write handle.toml"),
      said("capabilities fail"));
  CHECK_MESSAGE(contains(said("open fails"), "open failed: no handle on the desk; plug it in"), said("open fails"));
  CHECK_MESSAGE(contains(said("nonsense"), "peak force is negative"), said("nonsense"));
  CHECK_MESSAGE(contains(said("crash in open"), "ended by signal 6 (Aborted), in open"), said("crash in open"));
  CHECK_MESSAGE(contains(said("crash in capabilities"), "in capabilities"), said("crash in capabilities"));
  const TempFolder folder;
  const std::string crashing = why_not(as_file(copy_as(folder, "crashing.so")));
  CHECK_MESSAGE(contains(crashing, "while it was loaded"), crashing);
}

TEST_CASE("a plug-in that hangs in open is given up, and its process ended") {
  PluginOptions options = patient_plugin("open hangs");
  options.open_s = 0.3;
  const std::string said = why_not(options);
  CHECK_MESSAGE(contains(said, "did not open within 0.3 s"), said);
}

TEST_CASE("without the program that plug-ins run in the error names where it was looked for") {
  PluginOptions options = patient_plugin();
  options.host = "/nowhere/workbench-plugin";
  const std::string said = why_not(options);
  CHECK_MESSAGE(contains(said, "looked for /nowhere/workbench-plugin (No such file or directory)"), said);
  CHECK_MESSAGE(contains(said, "--plugin-in-process"), said);
}

TEST_CASE("an emergency stop reaches the plug-in past the servo, and holds until a person clears it") {
  for (const bool within : kWithin) {
    CAPTURE(within);
    const TempFolder folder;
    PluginOptions options = patient_plugin();
    options.settings = {{"log", folder.file("log")}};
    options.in_process = within;
    PluginBench bench(options);
    bench.arm();
    CHECK(bench.device.emergency_stop());
    CHECK(in_the_end([&] { return read_text(folder.file("log")) == "open stop "; }));
    bench.step(2);
    CHECK(bench.sample.state == DeviceState::faulted);
    CHECK(bench.sample.fault == DeviceFault::watchdog);
    CHECK_FALSE(bench.pushes());
    bench.step(DeviceRequest::clear_fault);
    bench.step();
    CHECK(bench.sample.state == DeviceState::ready);
    bench.device.close();
    CHECK_FALSE(bench.device.emergency_stop());
  }
}

TEST_CASE("a force that was on its way in an emergency stop does not outlast it") {
  for (const bool within : kWithin) {
    CAPTURE(within);
    const TempFolder folder;
    PluginOptions options = patient_plugin("waits for stop", 100);
    options.settings.emplace_back("log", folder.file("log"));
    options.in_process = within;
    PluginBench bench(options);
    bench.arm();
    while (bench.tick < 100) bench.step();
    std::thread emergency([&] {
      CHECK(in_the_end([&] { return contains(read_text(folder.file("log")), "waits "); }));
      CHECK(bench.device.emergency_stop());
    });
    bench.step();  // the plug-in takes the force, and returns when it is told to stop
    emergency.join();
    CHECK(read_text(folder.file("log")) == "open waits stop stop ");
    CHECK(bench.sample.state == DeviceState::faulted);
  }
}

TEST_CASE("a plug-in within the program is not closed while an emergency stop goes on in it") {
  const TempFolder folder;
  PluginOptions options = patient_plugin("slow stop", 0);
  options.settings.emplace_back("log", folder.file("log"));
  options.in_process = true;
  PluginForceDevice device(options);
  REQUIRE(device.open());
  std::thread emergency([&] { CHECK(device.emergency_stop()); });
  CHECK(in_the_end([&] { return read_text(folder.file("log")) == "open stopping "; }));
  device.close();
  emergency.join();
  CHECK(read_text(folder.file("log")) == "open stopping stop stop close ");
  CHECK_FALSE(device.emergency_stop());
}

TEST_CASE("a force that was worked out for a plug-in before this one is not passed on") {
  PluginProcess line(patient_plugin());
  const auto can = line.describe();
  REQUIRE(can);
  REQUIRE(line.open(*can));
  PluginCommand command{.number = 1};
  command.command = {.size = sizeof command.command, .request = 0, .tick = 1, .dt_s = 1e-3, .force_n = {0.0, 0.0, 1.0}};
  PluginTurn turn = line.exchange(command, kForever_s);
  REQUIRE(turn.answered);
  CHECK(turn.answer.sample.force_n[2] == 0.0);  // of none
  command.number = 2;
  command.connection = turn.connection;
  turn = line.exchange(command, kForever_s);
  REQUIRE(turn.answered);
  CHECK(turn.answer.sample.force_n[2] == 1.0);
}

TEST_CASE("a plug-in can't cut off the memory that it shares with the program") {
  PluginRegion region;
  REQUIRE(region.create());
  CHECK(::ftruncate(region.descriptor(), 0) != 0);
  CHECK(::ftruncate(region.descriptor(), 1 << 20) != 0);
  region.to_program().bell.store(1);  // still there
}

TEST_CASE("the plug-in's process stops the device when no command comes") {
  const TempFolder folder;
  PluginOptions options = patient_plugin();
  options.settings = {{"log", folder.file("log")}};
  options.watchdog_s = 0.01;
  PluginBench bench(options);
  CHECK(in_the_end([&] {
    bench.step();
    return bench.sample.state != DeviceState::absent;
  }));
  CHECK(in_the_end([&] { return contains(read_text(folder.file("log")), "open stop "); }));
  bench.step();
  CHECK(bench.sample.state == DeviceState::faulted);
  CHECK(bench.sample.fault == DeviceFault::watchdog);
  CHECK_FALSE(bench.pushes());
}

TEST_CASE("when the program is killed, its plug-in stops and closes the device, and ends") {
  const TempFolder folder;
  const pid_t program = ::fork();
  if (program == 0) {  // as if it were the program; nothing of the tests' framework is used here
    PluginOptions options = patient_plugin();
    options.settings = {{"log", folder.file("log")}};
    PluginForceDevice device(options);
    if (!device.open()) ::_exit(1);
    for (int i = 0; i < 3; ++i) device.exchange({}, 1e-3);
    folder.write("runs", "yes");
    while (true) ::pause();
  }
  CHECK(in_the_end([&] { return std::filesystem::exists(folder.file("runs")); }));
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  CHECK(in_the_end([&] { return contains(read_text(folder.file("log")), "close "); }));
  CHECK(read_text(folder.file("log")).starts_with("open stop "));
}

TEST_CASE("when the program is killed while a plug-in hangs before it is opened, its process ends, too") {
  const TempFolder folder;
  const pid_t program = ::fork();
  if (program == 0) {
    PluginOptions options = patient_plugin("hangs in capabilities");
    options.settings.emplace_back("log", folder.file("log"));
    PluginForceDevice device(options);
    ::_exit(1);
  }
  CHECK(in_the_end([&] { return read_text(folder.file("log")).ends_with(' '); }));
  const std::string process = "/proc/" + std::to_string(std::atoi(read_text(folder.file("log")).c_str()));
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  CHECK(in_the_end([&] { return read_text(process + "/cmdline").empty(); }));  // gone, or dead and not yet reaped
}

TEST_CASE("200 ticks at 1 kHz: each is answered") {
  PluginBench bench(patient_plugin());
  bench.arm();
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  for (int i = 0; i < 200; ++i) {
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) {
      due.tv_nsec -= 1'000'000'000;
      ++due.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    bench.step();
    CHECK(bench.sample.age_s == 0.0);
  }
  LinkReport report;
  bench.device.report(report);
  CHECK(report.lost == 0);
  CHECK(report.late == 0);
  CHECK(report.refused_sends == 0);
  CHECK(bench.gate.state() == GateState::armed);
}

TEST_CASE("measure: 10,000 ticks through plugin" * doctest::skip()) {
  for (const bool within : kWithin) {
    PluginOptions options;
    options.path = testing::faulty_plugin();
    options.host = testing::plugin_host();
    options.in_process = within;
    rusage before{}, after{}, theirs{};
    double wall_s = 0.0, slowest_s = 0.0, sum_s = 0.0;
    LinkReport report;
    {
      PluginBench bench(options);
      bench.arm();
      getrusage(RUSAGE_THREAD, &before);
      timespec due{};
      clock_gettime(CLOCK_MONOTONIC, &due);
      const auto began = std::chrono::steady_clock::now();
      for (int i = 0; i < 10'000; ++i) {
        due.tv_nsec += 1'000'000;
        if (due.tv_nsec >= 1'000'000'000) {
          due.tv_nsec -= 1'000'000'000;
          ++due.tv_sec;
        }
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
        const auto then = std::chrono::steady_clock::now();
        bench.sample = bench.device.exchange({.tick = bench.tick++}, 1e-3);
        const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
        slowest_s = std::max(slowest_s, took_s);
        sum_s += took_s;
      }
      wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      getrusage(RUSAGE_THREAD, &after);
      bench.device.report(report);
    }
    getrusage(RUSAGE_CHILDREN, &theirs);
    const auto cpu = [](const rusage& r) {
      return static_cast<double>(r.ru_utime.tv_sec + r.ru_stime.tv_sec) +
             1e-6 * static_cast<double>(r.ru_utime.tv_usec + r.ru_stime.tv_usec);
    };
    std::printf("| %s | %llu | %llu | %llu | %.1f us | %.0f us | %.2f %% | %.2f %% |\n",
                within ? "within the program" : "a process of its own", static_cast<unsigned long long>(report.lost),
                static_cast<unsigned long long>(report.late), static_cast<unsigned long long>(report.refused_sends),
                1e6 * sum_s / 10'000, 1e6 * slowest_s, 100.0 * (cpu(after) - cpu(before)) / wall_s,
                within ? 0.0 : 100.0 * cpu(theirs) / wall_s);
  }
}
