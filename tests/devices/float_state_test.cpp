#include "core/base/float_state.h"

#include "devices/safety_gate.h"
#include "devices/simulated/simulated_contact_display.h"
#include "devices/simulated/simulated_force_device.h"
#include "tests/support/processor_state.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace tangent;
using namespace tangent::testing;

#if defined(__x86_64__)
namespace {

constexpr double kLoopTick_s = 1e-3;

/// Everything that a loop of devices and gate computes, in this state of the processor: a hand pushes into a wall of
/// 400 N/m and comes out of it again, the roller follows.
std::vector<double> loop_under(unsigned state) {
  SimulatedForceDevice device;
  SimulatedContactDisplay display;
  REQUIRE(device.open());
  REQUIRE(display.open());
  const ForceCapabilities& can = device.capabilities();
  SafetyGate gate({.peak_force_n = can.peak_force_n,
                   .slew_n_per_s = 2000.0,
                   .display_travel_m = 0.02,
                   .continuous_force_n = can.continuous_force_n});
  const auto under_state = [state](auto call) {
    const ProcessorState processor(state);
    const auto result = call();
    CHECK((_mm_getcsr() & ~kHappened) == state);
    return result;
  };
  std::vector<double> seen;
  ForceCommand command;
  double target_m = 0.0;
  for (int tick = 0; tick < 1500; ++tick) {
    device.lead({.position_m = {0.0, 0.0, -8e-3 * std::sin(3.0 * kLoopTick_s * tick)}});
    command.force_n = under_state([&] { return gate.before_sending(kLoopTick_s); });
    command.request = tick == 0 ? DeviceRequest::home : DeviceRequest::none;
    const ForceSample sample = under_state([&] { return device.exchange(command, kLoopTick_s); });
    const DisplaySample roller =
        under_state([&] { return display.exchange({.target_m = target_m, .request = command.request}, kLoopTick_s); });
    if (tick == 400) gate.arm();
    const double depth_m = std::max(0.0, -sample.position_m.z);
    const GateInput input{.force_n = {0.0, 1e-310 * tick, 400.0 * depth_m},
                          .display_m = depth_m,
                          .force_device = sample.state,
                          .display = roller.state,
                          .position_m = sample.position_m,
                          .display_measured_m = roller.position_m,
                          .stiffness_n_per_m = 400.0,
                          .elastic_n = 400.0 * depth_m};
    const GateOutput out = under_state([&] { return gate.pass(input, kLoopTick_s); });
    target_m = out.display_m;
    for (int k = 0; k < 3; ++k) seen.insert(seen.end(), {out.force_n[k], device.exact_position_m()[k]});
    seen.insert(seen.end(),
                {out.display_m, roller.position_m, static_cast<double>(out.fault), gate.heat().store_n2s()});
  }
  CHECK(gate.state() == GateState::armed);
  return seen;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("gate and simulated devices compute the same however the program's processor state is, and leave it") {
  const std::vector<double> tested = loop_under(kAsTested);
  CHECK(same_bits(tested, loop_under(kFlushed)));
  CHECK(same_bits(tested, loop_under(kUpwards)));
  CHECK(same_bits(tested, loop_under(kTrapping)));
}
#endif
