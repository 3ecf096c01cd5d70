#include "workbench/session/exchange_watch.h"

#include "tests/workbench/session/session_fixture.h"
#include "workbench/session/servo.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Hangs in an exchange until it is told to stop.
struct HangingForceDevice final : ForceDevice {
  ForceCapabilities caps{.name = "hanging", .peak_force_n = 8.5};
  std::atomic<bool> hang{false}, stopped{false};
  std::atomic<int> exchanges{0};

  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override { return {}; }
  void close() override {}
  bool emergency_stop() noexcept override {
    stopped = true;
    return true;
  }
  ForceSample exchange(const ForceCommand&, double) noexcept override {
    ++exchanges;
    while (hang && !stopped) std::this_thread::yield();
    ForceSample sample;
    sample.position_m = Vec3(0, 0, 0.2);
    sample.state = DeviceState::ready;
    return sample;
  }
};

}  // namespace

TEST_CASE("an exchange is found to hang after 12 ms, once, and its device is told to stop") {
  DeviceSet devices;
  auto* device = new HangingForceDevice;
  devices.force.reset(device);
  ExchangeWatch watch(devices);
  constexpr std::int64_t ms = 1'000'000;
  CHECK_FALSE(watch.look(500 * ms));
  watch.begin(ExchangeWith::force_device, 1000 * ms);
  CHECK_FALSE(watch.look(1012 * ms));
  CHECK_FALSE(watch.end());
  CHECK_FALSE(watch.look(2000 * ms));  // between two exchanges
  watch.begin(ExchangeWith::force_device, 3000 * ms);
  CHECK(watch.look(3013 * ms));
  CHECK(device->stopped);
  CHECK(watch.hung() == ExchangeWith::force_device);
  CHECK(watch.was_stopped());
  CHECK(watch.hangs_now());
  CHECK_FALSE(watch.look(3020 * ms));
  CHECK(watch.end());
  CHECK_FALSE(watch.hangs_now());
  CHECK(watch.hung() == ExchangeWith::force_device);  // to be shown
  watch.begin(ExchangeWith::display, 4000 * ms);
  CHECK(watch.look(4013 * ms));
  CHECK(watch.hung() == ExchangeWith::display);
  CHECK_FALSE(watch.was_stopped());  // there is none
  CHECK(ExchangeWatch::kLongest_ns + ExchangeWatch::kLook_ns < 20 * ms);
}

TEST_CASE("a device that hangs under the servo is told to stop by another thread, and the gate stops") {
  DeviceSet set;
  auto* device = new HangingForceDevice;
  set.force.reset(device);
  ServoChannels channels(4096);
  ServoStatistics statistics;
  ServoTick tick(set, channels, statistics, std::make_unique<PreparedScene>(sphere_scene(), Finger{}), {},
                 &monotonic_ns);
  MonotonicClock clock;
  ServoOptions options;
  options.realtime = false;
  options.watch_exchanges = true;
  Servo servo(tick, statistics, options, clock);
  channels.force.put(ForceSwitch::arm);
  servo.start();
  ServoStatus status;
  do {
    std::this_thread::yield();
    statistics.fill(status);
  } while (status.gate_state != GateState::armed);
  device->hang = true;
  do {  // the watching thread frees it: without it this never ends
    std::this_thread::yield();
    statistics.fill(status);
  } while (status.gate_state != GateState::faulted);
  servo.stop();
  CHECK(device->stopped);
  CHECK(status.gate_fault == GateFault::exchange_hung);
  CHECK(tick.exchange_watch().hung() == ExchangeWith::force_device);
}
