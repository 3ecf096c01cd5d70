#include "workbench/session/exchange_watch.h"

#include "tests/workbench/session/calling_driver.h"
#include "tests/workbench/session/session_fixture.h"
#include "workbench/session/servo.h"
#include "workbench/session/session.h"

#include <doctest/doctest.h>

#include <atomic>
#include <string>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Hangs in an exchange until it is told to stop.
struct HangingForceDevice final : ForceDevice {
  ForceCapabilities caps{.name = "hanging", .peak_force_n = 8.5};
  std::atomic<bool> hang{false}, stopped{false};
  std::atomic<int> exchanges{0};
  std::atomic<bool> freed_by_stop{true};  ///< a stop by the other way ends the exchange, too
  std::atomic<bool> last_was_stop{false};

  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override { return {}; }
  void close() override {}
  bool emergency_stop() noexcept override {
    stopped = true;
    return true;
  }
  ForceSample exchange(const ForceCommand& command, double) noexcept override {
    ++exchanges;
    while (hang && !(stopped && freed_by_stop)) std::this_thread::yield();
    last_was_stop = command.request == DeviceRequest::stop;
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

TEST_CASE("a device that never returns holds nothing up, is told to stop, and finds all it needs should it return") {
  auto* device = new HangingForceDevice;  // owned by a session that is left behind
  device->freed_by_stop = false;
  SessionOptions options;
  options.servo.realtime = false;
  options.servo.longest_stop_s = 0.05;
  options.history_s = 1.0;
  DeviceSet set;
  set.force.reset(device);
  auto session = Session::create(sphere_scene(), Preset{}, options, std::move(set));
  REQUIRE(session);
  REQUIRE((*session)->start());
  while (device->exchanges < 10) std::this_thread::yield();
  device->hang = true;
  while (!device->stopped) std::this_thread::yield();
  const int before = device->exchanges;
  const Status ended = (*session)->shut_down();
  REQUIRE_FALSE(ended);
  CHECK(ended.error().message().find("the force device does not return from an exchange") != std::string::npos);
  CHECK(ended.error().message().find("told to stop by another way") != std::string::npos);
  CHECK(device->exchanges == before);
  CHECK_FALSE((*session)->start());
  session->reset();
  device->hang = false;  // its thread goes on, sends zero force and ends
  while (!(device->exchanges > before && device->last_was_stop)) std::this_thread::yield();
}

TEST_CASE("a device that calls us and hangs in a tick holds nothing up either") {
  struct Calling final : ForceDevice {
    HangingForceDevice inner;
    CallingDriver driver;
    Calling() {
      inner.freed_by_stop = false;
      inner.caps.rate_hz = 1000.0;
    }
    const ForceCapabilities& capabilities() const override { return inner.caps; }
    Status open() override { return {}; }
    void close() override {}
    bool emergency_stop() noexcept override { return inner.emergency_stop(); }
    ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
      return inner.exchange(command, dt_s);
    }
    bool calls_us() const override { return true; }
    Status start_calling(const DeviceTick& tick) override { return driver.start(tick); }
    void stop_calling() override { driver.stop(); }
  };
  auto* device = new Calling;
  SessionOptions options;
  options.servo.longest_stop_s = 0.05;
  DeviceSet set;
  set.force.reset(device);
  auto session = Session::create(sphere_scene(), Preset{}, options, std::move(set));
  REQUIRE(session);
  REQUIRE((*session)->start());
  while (device->inner.exchanges < 10) std::this_thread::yield();
  device->inner.hang = true;
  while (!device->inner.stopped) std::this_thread::yield();
  CHECK_FALSE((*session)->shut_down());
  session->reset();
  device->inner.hang = false;
  device->stop_calling();  // so that the test leaves no thread; the driver would go on calling in vain
}
