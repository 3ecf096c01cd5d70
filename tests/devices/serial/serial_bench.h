// Driver, line, firmware and gate, tick by tick: each tick waits until its bytes have arrived at both ends, and the
// driver's clock is the bench's. Nothing here depends on how fast the machine is.
#pragma once

#include "devices/device_safety.h"
#include "devices/safety_gate.h"
#include "devices/serial/serial_force_device.h"
#include "tests/devices/serial/serial_rig.h"
#include "tests/support/approx.h"

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

namespace tangent::serial_test {

using test::approx;

inline std::atomic<std::int64_t> bench_ns{1'000'000'000};
/// Happens once, when this thread next looks at the clock: in the middle of its exchange.
inline thread_local std::function<void()> in_exchange;
inline std::int64_t bench_now_ns() noexcept {
  if (in_exchange) std::exchange(in_exchange, nullptr)();
  return bench_ns.load();
}

/// Answers the host while it opens the device, which blocks.
class Answering {
 public:
  explicit Answering(SerialRig& rig)
      : thread_([this, &rig] {
          while (!done_)
            if (!rig.listen()) std::this_thread::sleep_for(std::chrono::microseconds(50));
        }) {}
  ~Answering() {
    done_ = true;
    thread_.join();
  }
  Answering(const Answering&) = delete;
  Answering& operator=(const Answering&) = delete;

 private:
  std::atomic<bool> done_{false};
  std::thread thread_;
};

inline SerialForceOptions bench_options(const DevFolder& dev) {
  SerialForceOptions options;
  options.dev = dev.path();
  options.now_ns = bench_now_ns;
  options.answer_s = 60.0;
  options.reopen_s = 1e-3;
  return options;
}

class SerialBench {
 public:
  static constexpr double kDt_s = 1e-3;

  explicit SerialBench(const tangent_description& is = three_axes())
      : rig(is),
        devices{std::make_unique<SerialForceDevice>(bench_options(dev)), nullptr},
        device(static_cast<SerialForceDevice&>(*devices.force)) {
    rig.plug_in(dev, "ttyACM0", kId);
    {
      const Answering answering(rig);
      const Status opened = device.open();
      CAPTURE((opened ? std::string() : opened.error().message()));
      REQUIRE(opened);
    }
    GateLimits limits = gate_limits(devices, 1000.0);
    limits.ramp_s = 5e-3;
    gate = std::make_unique<SafetyGate>(limits);
    meet();
  }

  static constexpr const char* kId = "usb-Tangent_Rig_77-if00";
  DevFolder dev;
  SerialRig rig;
  DeviceSet devices;
  SerialForceDevice& device;
  std::unique_ptr<SafetyGate> gate;
  ForceSample sample;
  GateOutput out;
  Vec3 wanted_n{0.0, 0.0, 1.0}, asked_n{0.0};
  bool connected = true;

  /// A tick `dt_s` after the last.
  void tick(DeviceRequest request = DeviceRequest::none, double dt_s = kDt_s) {
    bench_ns += std::llround(dt_s * 1e9);
    asked_n = gate->before_sending(dt_s);
    sample = device.exchange({.force_n = asked_n, .request = request}, dt_s);
    out = gate->pass({.force_n = wanted_n,
                      .force_device = sample.state,
                      .position_m = sample.position_m,
                      .position_age_s = sample.age_s,
                      .stiffness_n_per_m = 100.0,
                      .elastic_n = 1.0},
                     dt_s);
    ++exchanges_;
    if (!connected) return;
    REQUIRE(eventually([&] { return device.carried() >= exchanges_; }));
    meet();
    rig.step();
    meet();
  }
  /// Every byte of either end has arrived at the other.
  void meet() {
    REQUIRE(eventually([&] {
      rig.listen();
      return rig.bytes_in >= device.bytes_out() - out_before_ && device.bytes_in() - in_before_ >= rig.bytes_out;
    }));
  }
  bool reach(DeviceState state, int ticks = 100) {
    for (int i = 0; i < ticks && sample.state != state; ++i) tick();
    return sample.state == state;
  }
  /// Homed, armed, and pushing with what is wanted.
  void push() {
    REQUIRE(reach(DeviceState::firmware));
    tick(DeviceRequest::home);
    REQUIRE(reach(DeviceState::ready));
    gate->arm();
    for (int i = 0; i < 20; ++i) tick();
    CHECK(sample.state == DeviceState::ready);
    REQUIRE(sample.force_n == wanted_n);
    REQUIRE(rig.force_n[2] == approx(wanted_n.z));
  }
  void unplug() {
    dev.detach("ttyACM0", kId);
    rig.unplug();
    connected = false;
    REQUIRE(eventually([&] { return !report().connected; }));
  }
  /// With its firmware started again, or as it was: then only the cable was gone.
  void plug_in(const std::string& name, bool starts_again = true) {
    out_before_ = device.bytes_out();
    in_before_ = device.bytes_in();
    if (starts_again) rig.start_firmware();
    rig.plug_in(dev, name, kId);
    REQUIRE(eventually([&] {
      rig.listen();
      return report().connected && rig.bytes_out > 0;  // it was asked, and has answered
    }));
    connected = true;
    meet();
  }
  LinkReport report() const {
    LinkReport r;
    REQUIRE(device.report(r));
    return r;
  }

 private:
  std::uint64_t exchanges_ = 0, out_before_ = 0, in_before_ = 0;
};

}  // namespace tangent::serial_test
