// No exchange with a device on USB allocates: counted at malloc, in the servo's thread. The Falcon's driver with its
// faults is in falcon_cost_test.cpp, those that need no USB in tests/devices/exchange_allocation_test.cpp.
#include "devices/cld/cld_controller.h"
#include "devices/maestro/maestro_display.h"
#include "devices/plugin/host/allocation_watch.h"
#include "tests/devices/usb/emulation/cld_model.h"
#include "tests/devices/usb/emulation/maestro_model.h"
#include "tests/devices/usb/falcon_bench.h"

using namespace tangent;
using namespace tangent::emulation;

namespace {

struct Counted {
  std::uint64_t exchanges = 0, allocations = 0;
  template <class Exchange>
  auto run(Exchange&& exchange) {
    count_allocations();
    auto sample = exchange();
    allocations += counted_allocations();
    ++exchanges;
    return sample;
  }
};

/// Found, homed, moved, told to stop and to clear, unplugged and plugged in again.
void live(ContactDisplay& display, PluggedDevice& device) {
  Counted counted;
  const auto exchange = [&](double target_m = 0.0, DeviceRequest request = DeviceRequest::none) {
    return counted.run([&] { return display.exchange({.target_m = target_m, .request = request}, 1e-3); });
  };
  const auto reach = [&](DeviceState state) { return eventually([&] { return exchange().state == state; }); };
  device.plug_in();
  device.run();
  REQUIRE(display.open());
  for (int round = 0; round < 2; ++round) {
    REQUIRE(reach(DeviceState::firmware));
    exchange(0.0, DeviceRequest::home);
    REQUIRE(reach(DeviceState::ready));
    display.set_controller({});
    for (int i = 0; i < 200; ++i) exchange(1e-5 * i);
    for (const DeviceRequest request : {DeviceRequest::stop, DeviceRequest::clear_fault}) exchange(0.0, request);
    display.emergency_stop();
    for (int i = 0; i < 20; ++i) exchange(0.0, DeviceRequest::clear_fault);
    device.unplug();
    REQUIRE(reach(DeviceState::absent));
    device.plug_in();
  }
  display.close();
  CHECK(counted.exchanges > 400);
  CHECK(counted.allocations == 0);
}

}  // namespace

TEST_CASE("no exchange with a CLD controller allocates, found, homed, moved, stopped and unplugged") {
  Testbed testbed;
  CldModel model;
  model.watchdog_on = false;
  PluggedDevice device(testbed, model, 4);
  CldControllerOptions options;
  options.silence_s = 100.0;
  CldController cld(options);
  live(cld, device);
}

TEST_CASE("no exchange with a Maestro allocates, found, homed, moved, stopped and unplugged") {
  Testbed testbed;
  MaestroModel model;
  PluggedDevice device(testbed, model, 7);
  MaestroDisplay maestro({.channel = 0, .settle_s = 0.0});
  live(maestro, device);
}

TEST_CASE("no exchange with a Falcon on USB allocates, found, homed, pushed, stopped and unplugged") {
  FalconBench b;
  Counted counted;
  const auto exchange = [&](DeviceRequest request = DeviceRequest::none) {
    return counted.run([&] { return b.exchange({0.0, 0.0, 1.0}, request); });
  };
  const auto reach = [&](DeviceState state) { return eventually([&] { return exchange().state == state; }); };
  b.begin();
  for (int round = 0; round < 2; ++round) {
    REQUIRE(reach(DeviceState::ready));
    for (int i = 0; i < 200; ++i) exchange();
    b.falcon.emergency_stop();
    REQUIRE(reach(DeviceState::faulted));
    exchange(DeviceRequest::clear_fault);
    REQUIRE(reach(DeviceState::ready));
    b.device.unplug();
    REQUIRE(reach(DeviceState::absent));
    b.device.plug_in();
  }
  CHECK(counted.exchanges > 400);
  CHECK(counted.allocations == 0);
}
