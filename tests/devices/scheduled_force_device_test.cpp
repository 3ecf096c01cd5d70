#include "devices/simulated/scheduled_force_device.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

using namespace tangent;

namespace {

struct CountingTick {
  ForceDevice* device = nullptr;
  std::atomic<int> calls{0}, at_once{0}, most_at_once{0};
  std::thread::id caller;

  static void run(void* context) noexcept {
    auto& me = *static_cast<CountingTick*>(context);
    const int now = ++me.at_once;
    if (now > me.most_at_once) me.most_at_once = now;
    me.caller = std::this_thread::get_id();
    me.device->exchange({}, 1e-3);
    --me.at_once;
    ++me.calls;
  }
};

void wait_for_calls(const CountingTick& tick, int calls) {
  while (tick.calls < calls) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

TEST_CASE("a device that keeps the time calls the tick from a thread of its own, until it is told to stop") {
  ScheduledForceDevice device;
  REQUIRE(device.open());
  CountingTick tick;
  tick.device = &device;
  REQUIRE(device.start_calling({CountingTick::run, &tick}));
  wait_for_calls(tick, 20);
  device.stop_calling();
  const int calls = tick.calls;
  CHECK(tick.most_at_once == 1);
  CHECK(tick.caller != std::this_thread::get_id());
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(tick.calls == calls);
  REQUIRE(device.start_calling({CountingTick::run, &tick}));
  wait_for_calls(tick, calls + 5);
  device.close();
}

TEST_CASE("a device that is called says that it keeps no time") {
  SimulatedForceDevice device;
  CHECK_FALSE(device.calls_us());
  const Status refused = device.start_calling({});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().remedy == "call exchange by a clock");
}
