#include "devices/device_safety.h"

#include <doctest/doctest.h>

#include <limits>
#include <memory>

using namespace tangent;

namespace {

struct SayingForceDevice final : ForceDevice {
  ForceCapabilities caps;
  bool is_open = false;
  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override {
    is_open = true;
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

TEST_CASE("a device's largest stiffness caps what is asked for, where it is known") {
  SayingSet set;
  CHECK(stiffness_allowed(set.devices, 9000.0) == 9000.0);
  set.force->caps.largest_stiffness_n_per_m = 3500.0;
  CHECK(stiffness_allowed(set.devices, 9000.0) == 3500.0);
  CHECK(stiffness_allowed(set.devices, 800.0) == 800.0);
  CHECK(stiffness_allowed(DeviceSet{}, 9000.0) == 9000.0);
}
