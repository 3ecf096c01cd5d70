#include "devices/device_safety.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>

using namespace tangent;

namespace {

struct SayingForceDevice final : ForceDevice {
  ForceCapabilities caps;
  double continuous_once_open_n = 0.0;
  bool is_open = false;
  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override {
    is_open = true;
    caps.continuous_force_n = continuous_once_open_n;
    return {};
  }
  void close() override { is_open = false; }
  ForceSample exchange(const ForceCommand&, double) noexcept override { return {}; }
};

struct SayingDisplay final : ContactDisplay {
  DisplayCapabilities caps;
  bool is_open = false;
  const DisplayCapabilities& capabilities() const override { return caps; }
  Status open() override {
    is_open = true;
    return {};
  }
  void close() override { is_open = false; }
  DisplaySample exchange(const DisplayCommand&, double) noexcept override { return {}; }
};

struct SayingSet {
  SayingForceDevice* force = new SayingForceDevice;
  SayingDisplay* display = new SayingDisplay;
  DeviceSet devices;
  SayingSet() {
    devices.force.reset(force);
    devices.display.reset(display);
    force->caps.name = "arm";
    force->caps.peak_force_n = 8.5;
    display->caps.name = "roller";
  }
};

}  // namespace

TEST_CASE("a device that says nonsense is not opened, and its partner is closed again") {
  SayingSet good;
  CHECK(open_devices(good.devices));
  CHECK(good.force->is_open);
  CHECK(good.display->is_open);
  SayingSet bad_force;
  bad_force.force->caps.peak_force_n = std::numeric_limits<double>::quiet_NaN();
  const Status status = open_devices(bad_force.devices);
  REQUIRE_FALSE(status);
  CHECK(status.error().message().find("arm: peak force is not a finite number") == 0);
  CHECK_FALSE(bad_force.force->is_open);
  CHECK_FALSE(bad_force.display->is_open);
  SayingSet bad_once_open;
  bad_once_open.force->continuous_once_open_n = 9.0;  // above its peak
  CHECK_FALSE(open_devices(bad_once_open.devices));
  CHECK_FALSE(bad_once_open.force->is_open);
  CHECK_FALSE(bad_once_open.display->is_open);
  SayingSet bad_display;
  bad_display.display->caps.travel_m = -0.02;
  CHECK_FALSE(open_devices(bad_display.devices));
  CHECK_FALSE(bad_display.force->is_open);
  CHECK_FALSE(bad_display.display->is_open);
  DeviceSet none;
  CHECK(open_devices(none));
}

TEST_CASE("the gate's limits are the devices', in periods of the servo") {
  SayingSet set;
  set.force->caps.rate_hz = 500.0;
  set.display->caps.rate_hz = 2.0;  // not believed: no sample may be older than 10 ms
  set.display->caps.fastest_m_per_s = 0.1;
  const GateLimits limits = gate_limits(set.devices, 4000.0);
  CHECK(limits.period_s == 1.0 / 4000.0);
  CHECK(limits.peak_force_n == 8.5);
  CHECK(limits.sample_s == 2e-3);
  CHECK(limits.display_sample_s == limits.stale_s);
  CHECK(limits.fastest_target_m_per_s == 0.1);
  CHECK(check_limits(limits));
}

TEST_CASE("real devices without a time-out of their firmware are named, simulated ones are not") {
  SayingSet set;
  CHECK(devices_without_timeout(set.devices) == std::vector<std::string>{"arm", "roller"});
  set.force->caps.firmware_timeout_s = 0.05;
  CHECK(devices_without_timeout(set.devices) == std::vector<std::string>{"roller"});
  set.display->caps.simulated = true;
  CHECK(devices_without_timeout(set.devices).empty());
}

TEST_CASE("a device's largest stiffness and damping cap what is asked for, as felt there, where they are known") {
  const auto allowed = [](const DeviceSet& devices, double stiffness, double damping, double scale = 1.0) {
    Preset preset;
    preset.force.stiffness_n_per_m = stiffness;
    preset.force.damping_n_s_per_m = damping;
    preset = preset_allowed(preset, devices, scale);
    return Vec2(preset.force.stiffness_n_per_m, preset.force.damping_n_s_per_m);
  };
  SayingSet set;
  CHECK(allowed(set.devices, 9000.0, 50.0) == Vec2(9000.0, 50.0));
  set.force->caps.largest_stiffness_n_per_m = 3500.0;
  CHECK(allowed(set.devices, 9000.0, 50.0) == Vec2(3500.0, 50.0));
  set.force->caps.largest_damping_n_s_per_m = 8.0;
  CHECK(allowed(set.devices, 9000.0, 50.0) == Vec2(3500.0, 8.0));
  CHECK(allowed(set.devices, 800.0, 4.0) == Vec2(800.0, 4.0));
  // A scene twice as large on the device as in itself feels twice as stiff per metre of the hand.
  CHECK(allowed(set.devices, 9000.0, 50.0, 2.0) == Vec2(1750.0, 4.0));
  CHECK(allowed(set.devices, 9000.0, 12.0, 0.5) == Vec2(7000.0, 12.0));
  CHECK(allowed(DeviceSet{}, 9000.0, 50.0) == Vec2(9000.0, 50.0));
}

TEST_CASE("counts and a frame that can't be are refused") {
  const auto opens = [](auto change) {
    SayingSet set;
    change(set.force->caps);
    return open_devices(set.devices).has_value();
  };
  CHECK(opens([](ForceCapabilities& can) { can.senses_rotation = {true, true, true}; }));
  CHECK_FALSE(opens([](ForceCapabilities& can) { can.buttons = 33; }));
  CHECK_FALSE(opens([](ForceCapabilities& can) { can.largest_damping_n_s_per_m = -1.0; }));
  CHECK_FALSE(opens([](ForceCapabilities& can) { can.frame.rotation = Quat(2.0, 0.0, 0.0, 0.0); }));
  CHECK_FALSE(opens([](ForceCapabilities& can) { can.frame.origin_m.z = std::nan(""); }));
}
