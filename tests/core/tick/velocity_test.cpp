// The velocity that damping uses: filtered from the positions, or the device's own.
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kStep = 3e-5;  // m, of the encoders: 0.03 m/s of noise in raw differences at 1 kHz, 0.3 at 10
constexpr double kCutoff = 50.0;
constexpr double kNoise = 2.0 * std::numbers::pi * kCutoff * kStep;  // m/s: 9.4 mm/s, at any rate

Vec3 read_by_encoders(const Vec3& p) { return glm::round(p / kStep) * kStep; }

Preset damped() {
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.force.damping_n_s_per_m = 5.0;
  preset.force.blend = ForceBlend::off;
  preset.force.limit_n = 100.0;
  return preset;
}

ScenePtr plate() {
  static const ScenePtr scene = scene_of(height_field(0.060, 8, [](double, double) { return 0.0; }));
  return scene;
}

}  // namespace

TEST_CASE("encoder steps of 0.03 mm reach a damped force as less than damping times 9.4 mm/s, at 1 to 10 kHz") {
  const Preset preset = damped();
  Random random{61};
  for (const double hz : {1e3, 2e3, 5e3, 1e4}) {
    CAPTURE(hz);
    for (const double speed : {0.0, 0.02, 0.1}) {  // m/s, into the plate
      CAPTURE(speed);
      Stepper stepper(plate());
      TickState state;
      double most = 0.0;
      const int ticks = static_cast<int>(0.2 * hz);
      for (int i = 0; i < ticks; ++i) {
        const double t = i / hz;
        // Where it rests, it rests between two steps and reads either.
        const double dither = speed == 0.0 ? random.in(-0.6, 0.6) * kStep : 0.0;
        const Vec3 at = read_by_encoders({0.001, 0.002, 0.019 - speed * t + dither});
        const TickOutput out = stepper.step(preset, at_position(t, at), state);
        const double pressed = 800.0 * (0.020 - at.z);
        if (t > 0.1) most = std::max(most, std::abs(out.force_n.z - pressed - 5.0 * speed));
      }
      CHECK(most < 5.0 * kNoise + 5.0 * speed * std::exp(-0.1 * 2.0 * std::numbers::pi * kCutoff));
    }
  }
}

TEST_CASE("the filter lags by 1/(2 pi f): a velocity that grows evenly is seen as it was that long ago") {
  Preset preset = damped();
  preset.force.damping_n_s_per_m = 1.0;
  for (const double cutoff : {20.0, 50.0, 200.0}) {
    preset.force.velocity_cutoff_hz = cutoff;
    Stepper stepper(plate());
    TickState state;
    const double lag = 1.0 / (2.0 * std::numbers::pi * cutoff), a = 0.2;  // m/s2
    for (int i = 0; i < 4000; ++i) {
      const double t = 1e-4 * i, z = 0.0199 - 0.5 * a * t * t;
      const TickOutput out = stepper.step(preset, at_position(t, {0.0, 0.0, z}), state);
      if (t < 0.2) continue;
      const double seen = out.force_n.z - 800.0 * (0.020 - z);
      CHECK(std::abs(seen - a * (t - lag)) < 0.01 * a * lag + 1e-4 * a);
    }
  }
}

TEST_CASE("the device's own velocity is used as it is, and one that is no number is not") {
  const Preset preset = damped();
  Stepper own(plate()), none(plate());
  TickState a, b;
  for (int i = 0; i < 50; ++i) {
    TickInput input = at_position(1e-3 * i, {0.0, 0.0, 0.019});
    CHECK(none.step(preset, input, b).force_n.z == approx(0.8));
    input.velocity = Vec3(0.3, 0.0, -0.04);
    CHECK(own.step(preset, input, a).force_n.z == approx(0.8 + 5.0 * 0.04));
  }
  TickInput broken = at_position(0.05, {0.0, 0.0, 0.019});
  broken.velocity = Vec3(0.0, 0.0, std::nan(""));
  CHECK(none.step(preset, broken, b).force_n.z == approx(0.8));
}

TEST_CASE("stamps nearer to each other than a microsecond, or equal, don't blow damping up") {
  Preset preset = damped();
  for (const double dt : {1e-7, 1e-9, 1e-12, 0.0}) {
    CAPTURE(dt);
    Stepper stepper(plate());
    TickState state;
    double t = 0.0, most = 0.0;
    for (int i = 0; i < 400; ++i) {
      t += i % 2 ? dt : 1e-3;
      const double z = 0.019 + (i % 4 < 2 ? 0.0 : kStep);
      const TickOutput out = stepper.step(preset, at_position(t, {0.0, 0.0, z}), state);
      most = std::max(most, std::abs(out.force_n.z - 800.0 * (0.020 - z)));
    }
    CHECK(most < 5.0 * kNoise);
  }
}
