#include "devices/simulated/simulated_force_device.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kForceDt = 1e-3;

SimulatedForceOptions ideal_force() {
  SimulatedForceOptions o;
  o.tremor_m = o.position_step_m = o.friction_n = 0.0;
  return o;
}

void make_force_ready(SimulatedForceDevice& device) {
  REQUIRE(device.open());
  device.exchange({.request = DeviceRequest::home}, kForceDt);
  for (int i = 0; i < 200; ++i) device.exchange({}, kForceDt);
  REQUIRE(device.exchange({}, kForceDt).state == DeviceState::ready);
}

/// Presses on a spring along z that pushes back below z = 0, with the command one tick old.
std::vector<ForceSample> press(SimulatedForceDevice& device, double target_z, double stiffness, int ticks) {
  std::vector<ForceSample> samples;
  Vec3 force(0.0);
  for (int i = 0; i < ticks; ++i) {
    device.lead({.position_m = Vec3(0, 0, target_z)});
    samples.push_back(device.exchange({.force_n = force}, kForceDt));
    force = Vec3(0, 0, stiffness * std::max(0.0, -samples.back().position_m.z));
  }
  return samples;
}

}  // namespace

TEST_CASE("the force device homes before it is ready, and renders no force before") {
  SimulatedForceDevice device;
  CHECK(device.exchange({.force_n = Vec3(1, 0, 0)}, kForceDt).state == DeviceState::absent);
  REQUIRE(device.open());
  CHECK_FALSE(device.open());
  ForceSample sample = device.exchange({.force_n = Vec3(1, 0, 0)}, kForceDt);
  CHECK(sample.state == DeviceState::firmware);
  CHECK(sample.force_n == Vec3(0.0));
  sample = device.exchange({.force_n = Vec3(1, 0, 0), .request = DeviceRequest::home}, kForceDt);
  CHECK(sample.state == DeviceState::homing);
  int ticks = 0;
  while (sample.state == DeviceState::homing) {
    CHECK(sample.force_n == Vec3(0.0));
    sample = device.exchange({.force_n = Vec3(1, 0, 0)}, kForceDt);
    REQUIRE(++ticks <= 101);
  }
  CHECK(ticks >= 100);
  CHECK(sample.state == DeviceState::ready);
  CHECK(sample.force_n == Vec3(1, 0, 0));
  device.close();
  CHECK(device.exchange({.force_n = Vec3(1, 0, 0)}, kForceDt).force_n == Vec3(0.0));
}

TEST_CASE("the pressing hand comes to rest where its spring balances the contact's") {
  SimulatedForceDevice device(ideal_force());
  make_force_ready(device);
  device.place({.position_m = Vec3(0, 0, 5e-3)});
  const auto samples = press(device, -2.25e-3, 800.0, 2000);
  CHECK(samples.back().position_m.z == approx(-2.25e-3 * 400.0 / 1200.0).epsilon(1e-6));
  CHECK(glm::length(device.velocity_m_per_s()) < 1e-9);
}

TEST_CASE("the free mass follows the closed form of a damped oscillator, to first order in the step") {
  // m x'' = -k x - b x' from x0 at rest: x = x0 e^{-a t} (cos w t + a / w sin w t).
  const auto worst_error = [](int substeps) {
    SimulatedForceOptions o = ideal_force();
    o.substeps = substeps;
    SimulatedForceDevice device(o);
    const double m = o.device_mass_kg + o.hand_mass_kg, a = o.hand_damping_n_s_per_m / (2.0 * m);
    const double w = std::sqrt(o.hand_stiffness_n_per_m / m - a * a);
    device.place({.position_m = Vec3(1e-3, 0, 0)});
    device.lead({});
    double worst = 0.0;
    for (int i = 1; i <= 300; ++i) {
      device.exchange({}, kForceDt);
      const double t = i * kForceDt;
      const double exact = 1e-3 * std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t));
      worst = std::max(worst, std::abs(device.exact_position_m().x - exact));
    }
    return worst;
  };
  const double coarse = worst_error(4), fine = worst_error(8);
  CHECK(coarse < 0.01e-3);
  CHECK(coarse / fine == approx(2.0).epsilon(0.05));
}

TEST_CASE("positions are read in steps of 0.03 mm") {
  SimulatedForceDevice device;
  REQUIRE(device.open());
  device.place({.position_m = Vec3(0.01234, -0.02345, 0.00456)});
  for (int i = 0; i < 50; ++i) {
    device.lead({.position_m = Vec3(0.01234, -0.02345, 0.00456), .velocity_m_per_s = Vec3(0.1, 0, 0)});
    const ForceSample sample = device.exchange({}, kForceDt);
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = sample.position_m[axis] / 0.03e-3;
      CHECK(std::abs(steps - std::round(steps)) < 1e-9);
      CHECK(std::abs(sample.position_m[axis] - device.exact_position_m()[axis]) <= 0.015e-3 + 1e-15);
    }
  }
}

TEST_CASE("the same seed and commands give the same bits, another seed another tremor") {
  const auto run = [](std::uint64_t seed) {
    SimulatedForceOptions o;
    o.seed = seed;
    SimulatedForceDevice device(o);
    make_force_ready(device);
    return press(device, -2e-3, 800.0, 5000);
  };
  const auto first = run(7), again = run(7), other = run(8);
  bool same = true, differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    same = same && std::memcmp(&first[i].position_m, &again[i].position_m, sizeof(Vec3)) == 0;
    differs = differs || first[i].position_m != other[i].position_m;
  }
  CHECK(same);
  CHECK(differs);
}

TEST_CASE("the tremor has the asked-for size") {
  SimulatedForceOptions o;
  o.position_step_m = o.friction_n = 0.0;
  o.tremor_m = 50e-6;
  // A stiff, light, critically damped hand passes the tremor on as it is: its corner lies at 160 Hz.
  o.hand_stiffness_n_per_m = 1e6 * o.device_mass_kg;
  o.hand_mass_kg = 0.0;
  o.hand_damping_n_s_per_m = 2e3 * o.device_mass_kg;
  SimulatedForceDevice device(o);
  double sum = 0.0;
  constexpr int kTicks = 200'000;
  for (int i = 0; i < kTicks; ++i) {
    device.exchange({}, kForceDt);
    sum += glm::dot(device.exact_position_m(), device.exact_position_m()) / 3.0;
  }
  CHECK(std::sqrt(sum / kTicks) == approx(50e-6).epsilon(0.1));
}

TEST_CASE("the motors saturate at their peak") {
  SimulatedForceDevice device(ideal_force());
  make_force_ready(device);
  const ForceSample sample = device.exchange({.force_n = Vec3(0, 300, 400)}, kForceDt);
  CHECK(glm::length(sample.force_n) == approx(8.5));
  CHECK(sample.force_n.y == approx(8.5 * 0.6));
}

TEST_CASE("a faulted force device renders nothing until it is cleared and homed") {
  for (const DeviceFault fault : {DeviceFault::disconnected, DeviceFault::sensor, DeviceFault::actuator}) {
    SimulatedForceDevice device(ideal_force());
    make_force_ready(device);
    device.inject(fault);
    ForceSample sample = device.exchange({.force_n = Vec3(0, 0, 1)}, kForceDt);
    CHECK(sample.state == DeviceState::faulted);
    CHECK(sample.fault == fault);
    CHECK(sample.force_n == Vec3(0.0));
    sample = device.exchange({.force_n = Vec3(0, 0, 1), .request = DeviceRequest::home}, kForceDt);
    CHECK(sample.state == DeviceState::faulted);
    CHECK(device.exchange({.request = DeviceRequest::clear_fault}, kForceDt).state == DeviceState::open);
    CHECK(device.exchange({.request = DeviceRequest::home}, kForceDt).state == DeviceState::homing);
  }
}

TEST_CASE("a command that is not finite faults the force device and moves nothing") {
  SimulatedForceDevice device(ideal_force());
  make_force_ready(device);
  const ForceSample sample =
      device.exchange({.force_n = Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0)}, kForceDt);
  CHECK(sample.fault == DeviceFault::bad_command);
  CHECK(sample.position_m == Vec3(0.0));
  CHECK(sample.force_n == Vec3(0.0));
}

TEST_CASE("a disconnected device repeats the last position it gave") {
  SimulatedForceDevice device;
  make_force_ready(device);
  device.place({.position_m = Vec3(0.03, 0, 0)});
  device.lead({.position_m = Vec3(0.03, 0, 0), .velocity_m_per_s = Vec3(0.1, 0, 0)});
  const Vec3 last = device.exchange({}, kForceDt).position_m;
  device.inject(DeviceFault::disconnected);
  for (int i = 0; i < 10; ++i) CHECK(device.exchange({}, kForceDt).position_m == last);
}

TEST_CASE("dry friction holds a mass until the pull exceeds it, and brakes a free one evenly") {
  SimulatedForceOptions o = ideal_force();
  o.friction_n = 0.04;
  o.hand_damping_n_s_per_m = 0.0;
  SimulatedForceDevice device(o);
  make_force_ready(device);
  const auto displaced_by = [&device](double force) {
    device.place({});
    for (int i = 0; i < 50; ++i) device.exchange({.force_n = Vec3(force, 0, 0)}, kForceDt);
    return device.exact_position_m().x;
  };
  CHECK(displaced_by(0.039) == 0.0);
  CHECK(displaced_by(0.050) > 1e-6);

  o.hand_stiffness_n_per_m = 0.0;
  SimulatedForceDevice coasting(o);
  coasting.place({.velocity_m_per_s = Vec3(0.1, 0, 0)});
  coasting.lead({});
  for (int i = 0; i < 100; ++i) coasting.exchange({}, kForceDt);
  CHECK(coasting.velocity_m_per_s().x == approx(0.1 - 0.1 * 0.04 / 0.175).epsilon(1e-9));
  for (int i = 0; i < 1000; ++i) coasting.exchange({}, kForceDt);
  CHECK(coasting.velocity_m_per_s() == Vec3(0.0));
}

TEST_CASE("injected faults of the force device: named, and over after their time") {
  SimulatedForceDevice device;
  make_force_ready(device);
  const auto sample = [&device] {
    device.lead({.position_m = device.exact_position_m(), .velocity_m_per_s = Vec3(0.1, 0, 0)});
    return device.exchange({}, kForceDt);
  };
  for (int i = 0; i < 300; ++i) sample();
  for (const InjectedFault kind : {InjectedFault::delay_burst, InjectedFault::stuck_encoder}) {
    const Vec3 before = sample().position_m;
    device.inject({kind, 10});
    for (int i = 1; i <= 10; ++i) {
      const ForceSample s = sample();
      CHECK(s.position_m == before);
      CHECK(s.age_s == approx(kind == InjectedFault::delay_burst ? i * kForceDt : 0.0).scale(kForceDt));
    }
    const ForceSample after = sample();
    CHECK(after.age_s == 0.0);
    CHECK(glm::length(after.position_m - before) > 0.5e-3);
  }
  device.inject({InjectedFault::noise, 10});
  double furthest = 0.0;
  for (int i = 0; i < 10; ++i)
    furthest = std::max(furthest, glm::length(sample().position_m - device.exact_position_m()));
  CHECK(furthest > 10e-3);
  CHECK(glm::length(sample().position_m - device.exact_position_m()) < 0.1e-3);

  device.inject({InjectedFault::drop_out, 3});
  CHECK(sample().fault == DeviceFault::disconnected);
  CHECK(device.exchange({.request = DeviceRequest::clear_fault}, kForceDt).state == DeviceState::faulted);
  CHECK(device.exchange({.request = DeviceRequest::clear_fault}, kForceDt).state == DeviceState::faulted);
  CHECK(device.exchange({.request = DeviceRequest::clear_fault}, kForceDt).state == DeviceState::open);
}

TEST_CASE("faults are known by name") {
  CHECK(injected_fault_names().size() == 4);
  for (const std::string_view name : injected_fault_names()) {
    const auto fault = injected_fault(name);
    REQUIRE(fault);
    CHECK(to_string(*fault) == name);
  }
  const auto wrong = injected_fault("gremlins");
  REQUIRE_FALSE(wrong);
  CHECK(wrong.error().remedy.find("stuck-encoder") != std::string::npos);
}

TEST_CASE("a device that measures velocity says it, but not while its encoders stand still or it is not heard") {
  SimulatedForceDevice plain, tacho({.measures_velocity = true});
  const auto lead = [](SimulatedForceDevice& device, int i) {
    device.lead({.position_m = Vec3(1e-4 * i, 0.0, 0.0), .velocity_m_per_s = Vec3(0.1, 0.0, 0.0)});
    return device.exchange({}, 1e-3);
  };
  ForceSample sample;
  for (int i = 0; i < 500; ++i) {
    CHECK_FALSE(lead(plain, i).velocity_m_per_s.has_value());
    sample = lead(tacho, i);
  }
  REQUIRE(sample.velocity_m_per_s.has_value());
  CHECK(*sample.velocity_m_per_s == tacho.velocity_m_per_s());
  CHECK(sample.velocity_m_per_s->x == approx(0.1).epsilon(0.05));
  tacho.inject({InjectedFault::stuck_encoder, 3});
  CHECK_FALSE(lead(tacho, 501).velocity_m_per_s.has_value());
}

TEST_CASE(
    "of a finger's rotations a device gives those that it measures: alone they are exact, without them it is plain") {
  const Quat roll = glm::angleAxis(0.3, Vec3(1, 0, 0)), tilt = glm::angleAxis(-0.5, Vec3(0, 1, 0)),
             turn = glm::angleAxis(0.7, Vec3(0, 0, 1));
  const Quat whole = turn * tilt * roll;
  const auto near = [](const Quat& a, const Quat& b) { return std::abs(glm::dot(a, b)) > 1.0 - 1e-14; };
  CHECK(as_sensed(whole, {true, true, true}) == whole);
  CHECK(near(as_sensed(whole, {false, true, false}), tilt));
  CHECK(near(as_sensed(whole, {true, false, false}), roll));
  CHECK(near(as_sensed(whole, {false, false, true}), turn));
  CHECK(near(as_sensed(whole, {true, true, false}), tilt * roll));
  CHECK(as_sensed(whole, {false, false, false}) == Quat(1, 0, 0, 0));
}

TEST_CASE("a device that measures tilt alone: the finger points forward whatever the hand does, and tilts with it") {
  SimulatedForceOptions options = ideal_force();
  options.senses_rotation = {false, true, false};
  SimulatedForceDevice device(options);
  make_force_ready(device);
  CHECK(device.capabilities().rotations_sensed() == 1);
  CHECK(sensed_rotations(device.capabilities()) == "tilt");
  CHECK(sensed_rotations(SimulatedForceDevice().capabilities()) == "roll, tilt, turn");
  for (const double tilt : {-0.6, 0.0, 0.4}) {
    HandTarget hand;
    hand.orientation = glm::angleAxis(0.8, Vec3(0, 0, 1)) * glm::angleAxis(tilt, Vec3(0, 1, 0));
    device.lead(hand);
    const Vec3 points = device.exchange({}, kForceDt).orientation * Vec3(1, 0, 0);
    CHECK(glm::length(points - Vec3(std::cos(tilt), 0.0, -std::sin(tilt))) < 1e-14);
  }
}
