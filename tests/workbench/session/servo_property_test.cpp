// Random sequences through the whole servo tick: letters, device states, positions, gaps and stalls at any moment. What
// reaches the device is checked at every exchange. See tests/devices/gate/gate_property_test.cpp for the gate alone.
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

int servo_sequences() {
  if (const char* wanted = std::getenv("TANGENT_SEQUENCES")) return std::max(1, std::atoi(wanted) / 100);
  return rounds(3000);
}

/// A force device whose every sample is made up, and which looks at every command.
struct WaryForceDevice final : ForceDevice {
  ForceCapabilities caps{.name = "wary", .peak_force_n = 8.5};
  DeviceState state = DeviceState::ready;
  Vec3 position{0.0, 0.0, 0.059};
  double age_s = 0.0;
  std::uint32_t buttons = 0;
  bool must_be_zero = false;  ///< in the next exchange
  Vec3 last{0.0};
  std::string wrong;

  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override { return {}; }
  void close() override {}
  ForceSample exchange(const ForceCommand& command, double) noexcept override {
    const Vec3& f = command.force_n;
    const double size = std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z);
    if (!is_finite(f)) wrong = "not finite";
    if (size > caps.peak_force_n) wrong = "above the peak";
    if (must_be_zero && size > 0.0) wrong = "a force after a stop or a stall";
    if (size > 0.0 && glm::length(f - last) > 2.0 * (1.0 + 1e-9) && glm::length(f) > 0.5 * glm::length(last) + 1e-9)
      wrong = "changed too fast";
    last = f;
    ForceSample sample;
    sample.position_m = position;
    sample.age_s = age_s;
    sample.state = state;
    sample.buttons = buttons;
    return sample;
  }
};

struct ServoUnderTest {
  WaryForceDevice* device = new WaryForceDevice;
  TickBench bench;
  std::uint32_t presets = 0, placements = 0;
  Placement placed;
  bool may_arm = false, was_live = false;  ///< may: a person has pressed Arm since the last stop or fault

  static DeviceSet with(WaryForceDevice* wary) {
    DeviceSet set;
    set.force.reset(wary);
    return set;
  }
  /// Building a path takes longer than running over it.
  static std::unique_ptr<PreparedScene> prepared(bool torus) {
    const auto path = [](const ScenePtr& scene) { return ExplorationPath::build(*scene, pad_distance_m(Finger{})); };
    static const ExplorationPath over_sphere = path(sphere_scene()), over_torus = path(torus_scene());
    return torus ? std::make_unique<PreparedScene>(torus_scene(), over_torus)
                 : std::make_unique<PreparedScene>(sphere_scene(), over_sphere);
  }
  ServoUnderTest() : bench(with(device), prepared(false), {}, 1000.0, 64) {}

  std::string tick(double dt_s) {
    TickTiming timing = bench.pacer.begin(bench.pacer.deadline_ns());
    timing.dt_s = dt_s;
    if (dt_s > 20e-3) device->must_be_zero = true;
    bench.tick->run(timing);
    device->must_be_zero = false;
    ServoRecord r;
    while (bench.channels.gui.pop(r)) {}
    const bool live = r.device.gate_state == GateState::ramping || r.device.gate_state == GateState::armed;
    if (live && !may_arm) return "it armed by itself";
    if (was_live && !live) may_arm = false;  // until then the wish to arm waits for the device
    PlacementReport now;
    if (bench.channels.placed.take(now)) {
      const bool moved = !(now.placement == placed);
      placed = now.placement;
      // One that is not armed yet may arm in this very tick; it sends nothing before the next.
      if (moved && (device->last != Vec3(0.0) || (was_live && live) || now.refused))
        return "placed while force was sent";
      if (now.clutched && live) return "armed while the clutch was held";
    }
    was_live = live;
    if (!std::isfinite(r.device.energy_j)) return "the energy is not finite";
    return device->wrong;
  }

  std::string apply(std::uint32_t bits) {
    const unsigned kind = bits % 17, a = bits / 17 % 256;
    const double share = a / 255.0;
    double dt = 1e-3;
    if (kind == 1) {
      bench.arm();
      may_arm = true;
    } else if (kind == 2 || kind == 3) {
      bench.channels.force.put(kind == 2 ? ForceSwitch::stop : ForceSwitch::home);
      may_arm = false;
      device->must_be_zero = true;
    } else if (kind == 4) {
      dt *= 1.0 + a % 40;
    } else if (kind == 5) {
      device->position = Vec3(0, 0, 0.062 - 10e-3 * share);
    } else if (kind == 6) {
      device->position += 2e-3 * Vec3(share - 0.5, 0.5 - share, share - 0.5);
    } else if (kind == 7) {
      device->position.x = a % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e200;
    } else if (kind == 8) {
      device->position = Vec3(0, 0, 0.059);
      device->state = DeviceState::ready;
      device->age_s = 0.0;
    } else if (kind == 9) {
      device->state = static_cast<DeviceState>(a % 6);
    } else if (kind == 10) {
      device->age_s = 20e-3 * (share - 0.1);
    } else if (kind == 11) {
      Preset preset;
      preset.force.stiffness_n_per_m = 100.0 + 3400.0 * share;
      preset.force.damping_n_s_per_m = a % 3;
      preset.solver.method = static_cast<Method>(a % 6);
      bench.channels.presets.put({++presets, preset});
    } else if (kind == 12) {
      bench.channels.scenes.offer(prepared(a % 2 == 1));
    } else if (kind == 14) {
      const Quat turned = glm::angleAxis(6.0 * share, Vec3(0.6, 0.0, 0.8));
      bench.channels.placement.put(
          {++placements, {std::exp(4.0 * share - 2.0), turned, Vec3(0, 0, 0.02 * share)}, a % 2 == 0});
    } else if (kind == 15) {
      bench.channels.clutch = a % 2 == 0;
    } else if (kind == 16) {
      device->buttons = a % 4;
    }
    std::string wrong = tick(dt);
    for (unsigned i = 0; i < bits / 4352 % 64 && wrong.empty(); ++i) wrong = tick(1e-3);
    return wrong;
  }
};

}  // namespace

TEST_CASE(
    "whatever comes, in any order, the servo sends no more than the peak, nothing after a stop, never arms, and leaves "
    "a placement be") {
  std::uint64_t events = 0;
  const auto property = [&events](const std::vector<std::uint32_t>& sequence) {
    ServoUnderTest servo;
    std::string wrong = servo.apply(1 + 63 * 4352);
    for (std::size_t i = 0; i < sequence.size() && wrong.empty(); ++i) wrong = servo.apply(sequence[i]);
    events += sequence.size();
    servo.bench.channels.scenes.collect();
    if (!wrong.empty()) RC_FAIL(wrong);
  };
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = servo_sequences();
  params.maxSize = 40;
  if (std::getenv("TANGENT_SEQUENCES") == nullptr) params.seed = 1;  // the same every time, unless more are asked for
  rc::detail::TestMetadata about;
  about.description = "servo";
  const auto result = rc::detail::checkTestable(property, about, params);
  std::ostringstream said;
  rc::detail::printResultMessage(result, said);
  MESSAGE(events << " events in " << params.maxSuccess << " sequences");
  CHECK_MESSAGE(result.template is<rc::detail::SuccessResult>(), said.str());
}
