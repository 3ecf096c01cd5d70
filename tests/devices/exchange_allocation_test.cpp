// No driver's exchange allocates: it runs in the servo's thread. Counted at malloc, the drivers' libraries included.
#include "devices/device_set.h"
#include "devices/plugin/host/allocation_watch.h"
#include "tests/devices/dhd/dhd_stub_loader.h"
#include "tests/devices/openhaptics/hd_stub_loader.h"
#include "tests/devices/plugin/plugin_bench.h"
#include "tests/devices/serial/serial_bench.h"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace tangent;

namespace {

/// Exchanges with this force; how often one of them allocated.
template <class Between>
std::uint64_t allocations_in(ForceDevice& device, int exchanges, const Between& between,
                             DeviceRequest request = DeviceRequest::none) {
  std::uint64_t sum = 0;
  for (int i = 0; i < exchanges; ++i) {
    between();
    count_allocations();
    device.exchange({.tick = static_cast<std::uint64_t>(i), .force_n = Vec3(0.0, 0.0, 0.5), .request = request}, 1e-3);
    sum += counted_allocations();
  }
  return sum;
}

std::uint64_t allocations_in(ForceDevice& device, int exchanges, DeviceRequest request = DeviceRequest::none) {
  return allocations_in(
      device, exchanges, [] {}, request);
}

constexpr auto kStopAndClear = {DeviceRequest::stop, DeviceRequest::clear_fault, DeviceRequest::home};

}  // namespace

TEST_CASE("the allocations of a thread are counted") {
  count_allocations();
  void* volatile memory = std::malloc(8);
  std::free(memory);
  CHECK(counted_allocations() == 1);
}

TEST_CASE("no exchange with a simulated device allocates, homing, faults and requests included") {
  for (const char* name : {"simulated", "ideal", "scheduled", "tilt"}) {
    CAPTURE(name);
    const auto made = make_devices({name, "none"});
    REQUIRE(made);
    ForceDevice& device = *made->force;
    REQUIRE(device.open());
    CHECK(allocations_in(device, 5, DeviceRequest::home) == 0);
    CHECK(allocations_in(device, 500) == 0);
    for (const DeviceRequest request : kStopAndClear) CHECK(allocations_in(device, 5, request) == 0);
    device.close();
    CHECK(allocations_in(device, 5) == 0);
  }
}

TEST_CASE("no exchange over a serial line allocates, with answers, garbage, silence and an unplugged cable") {
  serial_test::SerialBench bench;
  bench.push();
  const auto step = [&bench] {
    serial_test::bench_ns += 1'000'000;
    bench.rig.listen();
    bench.rig.step();
  };
  for (const serial_test::Lie lie : {serial_test::Lie::none, serial_test::Lie::garbage, serial_test::Lie::silence}) {
    bench.rig.lie = lie;
    CHECK(allocations_in(bench.device, 100, step) == 0);
  }
  for (const DeviceRequest request : kStopAndClear) CHECK(allocations_in(bench.device, 5, step, request) == 0);
  bench.rig.unplug();
  CHECK(allocations_in(bench.device, 100) == 0);
}

TEST_CASE("no exchange with a plug-in allocates, in a process of its own or within, nor after it is gone") {
  for (const bool within : {false, true}) {
    CAPTURE(within);
    PluginOptions options = testing::patient_plugin("unplugged", 400);
    options.in_process = within;
    testing::PluginBench bench(options);
    bench.arm();
    CHECK(allocations_in(bench.device, 500) == 0);
    for (const DeviceRequest request : kStopAndClear) CHECK(allocations_in(bench.device, 5, request) == 0);
  }
}

TEST_CASE("no exchange through DHD allocates, whatever its calls return") {
  test::DhdLoop l;
  REQUIRE(l.start());
  l.push();
  CHECK(allocations_in(l.device, 300) == 0);
  l.dhd.call_error = 7;
  CHECK(allocations_in(l.device, 20) == 0);
  l.dhd.call_error = 0;
  for (const DeviceRequest request : kStopAndClear) CHECK(allocations_in(l.device, 5, request) == 0);
}

TEST_CASE("no tick of OpenHaptics' scheduler allocates, whatever its errors") {
  test::HdLoop l;
  REQUIRE(l.device.open());
  l.loop.know_the_device();
  struct Counted {
    test::GateLoop& loop;
    std::uint64_t sum = 0;
  } counted{l.loop};
  const auto run = [](void* context) noexcept {
    auto& c = *static_cast<Counted*>(context);
    count_allocations();
    c.loop.tick();
    c.sum += counted_allocations();
  };
  REQUIRE(l.device.start_calling({run, &counted}));
  l.push();
  counted.sum = 0;
  l.step(300);
  CHECK(counted.sum == 0);
  l.hd.frame_error = 0x0101;
  l.step(5);
  l.hd.frame_error = 0;
  l.loop.ask(DeviceRequest::clear_fault);
  l.step(20);
  CHECK(counted.sum == 0);
  l.device.close();
}
