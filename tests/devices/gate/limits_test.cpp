#include "devices/gate/limits.h"

#include "devices/contact_display.h"
#include "devices/force_device.h"
#include "devices/safety_gate.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kNot = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

ForceCapabilities an_arm() {
  ForceCapabilities can;
  can.name = "arm";
  can.peak_force_n = 8.5;
  can.continuous_force_n = 1.4;
  can.workspace_half_size_m = Vec3(0.1);
  can.rate_hz = 1000.0;
  return can;
}

}  // namespace

TEST_CASE("capabilities that are not finite, negative or out of order are refused by name") {
  CHECK(check_capabilities(an_arm()));
  CHECK(check_capabilities(ForceCapabilities{}));  // nothing known is no nonsense
  for (const double bad : {kNot, kEndless, -kEndless, -1e-9}) {
    for (double ForceCapabilities::*field :
         {&ForceCapabilities::peak_force_n, &ForceCapabilities::continuous_force_n,
          &ForceCapabilities::largest_stiffness_n_per_m, &ForceCapabilities::rate_hz,
          &ForceCapabilities::firmware_timeout_s, &ForceCapabilities::position_resolution_m,
          &ForceCapabilities::apparent_mass_kg}) {
      ForceCapabilities can = an_arm();
      can.*field = bad;
      const Status status = check_capabilities(can);
      REQUIRE_FALSE(status);
      CHECK(status.error().where == "arm");
      CHECK(!status.error().remedy.empty());
    }
    for (double DisplayCapabilities::*field :
         {&DisplayCapabilities::travel_m, &DisplayCapabilities::rate_hz, &DisplayCapabilities::firmware_timeout_s,
          &DisplayCapabilities::fastest_m_per_s}) {
      DisplayCapabilities can{.name = "roller", .travel_m = 0.02};
      can.*field = bad;
      CHECK_FALSE(check_capabilities(can));
    }
    for (int axis = 0; axis < 3; ++axis) {
      ForceCapabilities can = an_arm();
      can.workspace_half_size_m[axis] = bad;
      CHECK_FALSE(check_capabilities(can));
    }
  }
  ForceCapabilities can = an_arm();
  can.continuous_force_n = 9.0;
  const Status status = check_capabilities(can);
  REQUIRE_FALSE(status);
  CHECK(status.error().message().find("9 N, is above the peak force, 8.5 N") != std::string::npos);
}

TEST_CASE("a gate with limits that make no sense passes no force") {
  for (const double bad : {kNot, kEndless, -1.0}) {
    for (double GateLimits::*field :
         {&GateLimits::peak_force_n, &GateLimits::slew_n_per_s, &GateLimits::ramp_s, &GateLimits::stale_s,
          &GateLimits::late_s, &GateLimits::period_s, &GateLimits::fastest_m_per_s, &GateLimits::continuous_force_n,
          &GateLimits::fastest_target_m_per_s, &GateLimits::sample_s}) {
      GateLimits limits;
      limits.peak_force_n = 8.5;
      limits.ramp_s = 0.0;
      CHECK(check_limits(limits));
      limits.*field = bad;
      CHECK_FALSE(check_limits(limits));
      SafetyGate gate(limits);
      gate.arm();
      for (int i = 0; i < 5; ++i)
        CHECK(gate.pass({.force_n = Vec3(1, 0, 0), .force_device = DeviceState::ready}, 1e-3).force_n == Vec3(0.0));
    }
  }
}

TEST_CASE("the longest tick is twenty periods, never more than 20 ms, and one missed deadline at any rate") {
  const auto longest = [](double rate_hz) {
    GateLimits limits;
    limits.period_s = 1.0 / rate_hz;
    return longest_tick_s(limits);
  };
  CHECK(longest(10'000.0) == approx(2e-3));
  CHECK(longest(1000.0) == approx(20e-3));
  CHECK(longest(300.0) == approx(20e-3));
  CHECK(longest(100.0) == approx(20e-3));
  CHECK(longest(100.0) >= 2.0 / 100.0);
}

TEST_CASE("a homing time that is no length of time is refused") {
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    ForceCapabilities force{.name = "arm"};
    force.homing_s = bad;
    CHECK_FALSE(check_capabilities(force));
    DisplayCapabilities display;
    display.homing_s = bad;
    CHECK_FALSE(check_capabilities(display));
  }
}
