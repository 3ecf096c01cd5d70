// Scenes, device test doubles and a fake clock for the session's tests.
#pragma once

#include "core/lab/objects/generate.h"
#include "core/tick/step.h"
#include "devices/device_safety.h"
#include "tests/core/scenes.h"
#include "workbench/session/servo_clock.h"
#include "workbench/session/servo_tick.h"

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tangent::test {

inline std::shared_ptr<const ContactScene> sphere_scene() {
  static const auto scene = scene_of(make_icosphere(0.040, 3));
  return scene;
}

inline std::shared_ptr<const ContactScene> torus_scene() {
  static const auto scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  return scene;
}

/// A ball of 40 mm, of which nothing is built that can be built late.
inline std::shared_ptr<const ContactScene> late_ball() {
  auto mesh = ContactMesh::build(make_icosphere(0.040, 3));
  REQUIRE(mesh);
  auto scene = ContactScene::build(std::move(*mesh), {.far_parts = false, .whole_up_to = 0});
  REQUIRE(scene);
  return *scene;
}

/// Returns prescribed samples and records its commands.
struct PuppetForceDevice final : ForceDevice {
  ForceCapabilities caps{.name = "puppet", .peak_force_n = 8.5};
  DeviceState state = DeviceState::ready;
  Vec3 position{0.0};
  std::optional<Vec3> velocity;  // as it says it measures
  std::uint32_t buttons = 0;
  std::vector<ForceCommand> commands;
  std::function<void(PuppetForceDevice&)> before;

  PuppetForceDevice() { commands.reserve(100'000); }
  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override { return {}; }
  void close() override {}
  ForceSample exchange(const ForceCommand& command, double) noexcept override {
    commands.push_back(command);
    if (before) before(*this);
    ForceSample sample;
    sample.position_m = position;
    sample.velocity_m_per_s = velocity;
    sample.buttons = buttons;
    sample.state = state;
    sample.fault = state == DeviceState::faulted ? DeviceFault::sensor : DeviceFault::none;
    return sample;
  }
};

/// Time advances when a thread sleeps or a test sets it.
struct MadeUpClock final : ServoClock {
  std::int64_t time_ns = 1'000'000'000;
  std::function<std::int64_t()> oversleep_ns = [] { return std::int64_t{0}; };
  std::int64_t now_ns() noexcept override { return time_ns; }
  void sleep_until(std::int64_t deadline_ns) noexcept override {
    time_ns = std::max(time_ns, deadline_ns) + oversleep_ns();
  }
};

/// A ServoTick with its channels and devices, run tick by tick.
struct TickBench {
  DeviceSet devices;
  ServoChannels channels;
  ServoStatistics statistics;
  DeadlinePacer pacer;
  std::unique_ptr<ServoTick> tick;

  TickBench(DeviceSet set, std::shared_ptr<const ContactScene> scene, const Preset& preset = {},
            double rate_hz = 1000.0)
      : TickBench(std::move(set), std::make_unique<PreparedScene>(std::move(scene), preset.finger), preset, rate_hz) {}
  TickBench(DeviceSet set, std::unique_ptr<PreparedScene> prepared, const Preset& preset, double rate_hz,
            std::size_t ring_records = 4096)
      : devices(std::move(set)),
        channels(ring_records),
        pacer(rate_hz, false),
        tick(std::make_unique<ServoTick>(devices, channels, statistics, std::move(prepared), PresetLetter{0, preset},
                                         nullptr, rate_hz)) {
    pacer.start(0);
  }

  void arm() { channels.force.put(ForceSwitch::arm); }

  ServoRecord run() {
    tick->run(pacer.begin(pacer.deadline_ns()));
    ServoRecord record;
    REQUIRE(channels.gui.pop(record));
    return record;
  }
  ServoRecord run(int ticks) {
    ServoRecord record;
    for (int i = 0; i < ticks; ++i) record = run();
    return record;
  }
};

inline DeviceSet simulated(std::uint64_t seed = 1) {
  auto set = make_devices({}, DeviceOptions{.seed = seed});
  REQUIRE(set);
  return std::move(*set);
}

}  // namespace tangent::test
