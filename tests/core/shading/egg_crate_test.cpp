// Egg crates, where a finger finds several places, none, or one beside the pad at every other step: force and display
// change by no more than the finger's motion and a fade explain, whatever the finger does.
#include "core/base/tolerances.h"
#include "core/lab/measure/roughness.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kPeriod = 1e-3, kHalf = 0.030, kNear = 0.015;

struct Crate {
  double high_m, wave_m;
  double height(double x, double y) const {
    const double k = 2.0 * std::numbers::pi / wave_m;
    return high_m * std::sin(k * x) * std::sin(k * y);
  }
  /// Where the centre of a ball on top of it is, all but exactly.
  double rest(double radius_m, double x, double y) const {
    constexpr int kSteps = 6;
    double z = height(x, y) + radius_m;
    for (int i = -kSteps; i <= kSteps; ++i)
      for (int j = -kSteps; j <= kSteps; ++j) {
        const double a = radius_m * i / kSteps, b = radius_m * j / kSteps, left2 = radius_m * radius_m - a * a - b * b;
        if (left2 >= 0.0) z = std::max(z, height(x + a, y + b) + std::sqrt(left2));
      }
    return z;
  }
};

enum class Turning : std::uint8_t { none, tilted, on_its_side, on_its_back, about_any_axis };
enum class Stamps : std::uint8_t { even, equal_and_backwards };

struct Wander {
  Crate crate;
  double radius_m, speed_m_per_s, deep_m;
  Turning turning;
  Stamps stamps = Stamps::even;

  std::vector<TickInput> poses(int ticks, std::uint64_t seed) const {
    Random random{seed};
    const Vec3 axis = random.direction();
    double x = 0.001, y = 0.002, heading = random.in(0.0, 6.0), t_s = 0.0;
    std::vector<TickInput> way;
    for (int i = 0; i < ticks; ++i) {
      heading += random.in(-0.05, 0.05);
      x += kPeriod * speed_m_per_s * std::cos(heading);
      y += kPeriod * speed_m_per_s * std::sin(heading);
      if (std::hypot(x, y) > kNear) heading = std::atan2(-y, -x);
      const double in_and_out = deep_m * (0.5 + std::sin(0.01 * i));
      const Vec3 at(x, y, crate.rest(radius_m, x, y) - in_and_out);
      t_s += stamps == Stamps::even ? kPeriod : i % 7 == 0 ? -kPeriod : i % 5 == 0 ? 0.0 : kPeriod;
      way.push_back({t_s, {at, orientation(axis, i)}});
    }
    return way;
  }

 private:
  static Quat about(const Vec3& axis, double angle) { return {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis}; }
  Quat orientation(const Vec3& axis, int tick) const {
    switch (turning) {
      case Turning::none:
        return {1.0, 0.0, 0.0, 0.0};
      case Turning::tilted:
        return about(axis, 0.8);
      case Turning::on_its_side:
        return about({1.0, 0.0, 0.0}, 1.5);
      case Turning::on_its_back:
        return about({0.0, 1.0, 0.0}, 3.1);
      default:
        return about(axis, 10.0 * kPeriod * tick);
    }
  }
};

ScenePtr scene_of(const Crate& crate, double crease_deg) {
  ContactMeshOptions options;
  options.crease_rad = crease_deg * kDegree;
  return test::scene_of(height_field(kHalf, 48, [&](double x, double y) { return crate.height(x, y); }), options);
}

tangent::Roughness feel(const ScenePtr& scene, const Preset& preset, const std::vector<TickInput>& poses) {
  Stepper stepper(scene);
  TickState state;
  RoughnessCounter counter;
  for (const TickInput& input : poses) counter.add(preset, input, stepper.step(preset, input, state));
  return counter.result();
}

constexpr std::array kCrates{Crate{0.001, 0.005}, Crate{0.002, 0.010}, Crate{0.003, 0.010}, Crate{0.005, 0.020}};
constexpr std::array kTurnings{Turning::none, Turning::tilted, Turning::on_its_side, Turning::on_its_back,
                               Turning::about_any_axis};

}  // namespace

TEST_CASE("on egg crates force and display change by no more than the finger's motion and a fade explain") {
  const int ticks = rounds(700);
  std::uint64_t decided = 0, seed = 1;
  for (const Crate& crate : kCrates) {
    const ScenePtr smooth = scene_of(crate, 180.0), creased = scene_of(crate, 30.0);
    for (const double radius : {0.0, 0.005, 0.020})
      for (const Turning turning : kTurnings) {
        const double speed = std::array{0.02, 0.1, 0.3}[seed % 3], deep = std::array{5e-4, 3e-3}[seed % 2];
        const Stamps stamps = seed % 4 == 0 ? Stamps::equal_and_backwards : Stamps::even;
        const Wander wander{crate, radius, speed, deep, turning, stamps};
        CAPTURE(crate.high_m);
        CAPTURE(radius);
        CAPTURE(static_cast<int>(turning));
        Preset preset = sphere_preset(radius, Method::robust);
        if (seed % 5 == 0) preset.force.contacts = ForceContacts::deepest;
        const tangent::Roughness felt = feel(seed % 2 ? smooth : creased, preset, wander.poses(ticks, seed));
        CHECK(felt.force.unexplained == 0);
        CHECK(felt.display.unexplained == 0);
        decided += felt.decided_force.unexplained + felt.decided_display.unexplained;
        ++seed;
      }
  }
  MESSAGE(decided << " leaps of what was decided");
  CHECK(decided > 0);
}

TEST_CASE("while the contact is off the pad its place is none for the display, which stays") {
  // There the angle in the finger's section turns over at once: the place flips from end to end, 15.5 mm in a tick.
  for (const Turning turning : {Turning::on_its_side, Turning::on_its_back}) {
    const Wander wander{{0.002, 0.010}, 0.005, 0.3, 5e-4, turning};
    const Preset preset = sphere_preset(0.005, Method::robust);
    Stepper stepper(scene_of(wander.crate, 180.0));
    TickState state;
    int off = 0, moved = 0;
    double last_m = 0.0;
    for (const TickInput& input : wander.poses(rounds(700), 3)) {
      const TickOutput out = stepper.step(preset, input, state);
      const FingerSection section = section_of(input.finger.orientation);
      const double distal = glm::dot(out.normal, section.distal), dorsal = glm::dot(out.normal, section.dorsal);
      if (out.event != TickEvent::first && (dorsal < 0.0 || std::hypot(distal, dorsal) < kPadSection)) {
        ++off;
        moved += out.cld_m != last_m || out.decided_cld_m != last_m;
      }
      last_m = out.cld_m;
    }
    CHECK(off > 0);
    CHECK(moved == 0);
  }
}

namespace {

/// A finger of 5 mm on a crate, its display away from the centre, pressed as deep as this.
TickInput pressed(int i, double deep_m, double y = 0.0) {
  const Crate crate{0.002, 0.010};
  const double tilt = 0.3;
  const Vec3 at(0.0025, 0.0025 + y, crate.rest(0.005, 0.0025, 0.0025 + y) - deep_m);
  return {kPeriod * i, {at, {std::cos(tilt), 0.0, std::sin(tilt), 0.0}}};
}

}  // namespace

TEST_CASE("a time without a usable pose is not made up for in the tick after it") {
  const ScenePtr scene = scene_of({0.002, 0.010}, 180.0);
  for (const int gap : {3, 8, 30, 300}) {
    CAPTURE(gap);
    Stepper stepper(scene);
    TickState state;
    TickOutput last;
    double force_leap = 0.0, display_leap = 0.0;
    const Preset preset = sphere_preset(0.005, Method::robust);
    for (int i = 0; i < 100 + gap + 100; ++i) {
      TickInput input = pressed(i, 2e-3);
      const bool lost = i >= 100 && i < 100 + gap;
      if (lost) input.finger.position.x = std::numeric_limits<double>::quiet_NaN();
      const TickOutput out = stepper.step(preset, input, state);
      if (i > 0 && !lost) {
        force_leap = std::max(force_leap, glm::distance(out.force_n, last.force_n));
        display_leap = std::max(display_leap, std::abs(out.cld_m - last.cld_m));
      } else if (lost) {  // the ramp of 5 ms, no faster
        CHECK(glm::length(last.force_n) - glm::length(out.force_n) <= 1.001 * 2e-3 * 800.0 / 5.0);
      }
      last = out;
    }
    CHECK(std::abs(last.cld_m) > 1e-3);
    CHECK(force_leap <= 1.000001 * kPeriod * 20.0);
    CHECK(display_leap <= 1.000001 * kPeriod * 16.0 * preset.display.travel_m);
  }
}

TEST_CASE("after a time without a usable pose damping knows no velocity of the way over it") {
  Preset preset = sphere_preset(0.005, Method::robust);
  preset.force.damping_n_s_per_m = 20.0;
  Stepper stepper(scene_of({0.002, 0.010}, 180.0));
  TickState state;
  double most = 0.0, steady = 0.0;
  for (int i = 0; i < 300; ++i) {
    TickInput input = pressed(i, 5e-4 + 5e-6 * i);  // goes in at 5 mm/s: 0.1 N of damping
    if (i >= 100 && i < 140) input.finger.position.x = std::numeric_limits<double>::quiet_NaN();
    stepper.step(preset, input, state);
    if (i == 99) steady = glm::length(state.rendered.velocity);
    if (i >= 140) most = std::max(most, glm::length(state.rendered.velocity));
  }
  CHECK(steady == approx(5e-3));
  CHECK(most <= 1.001 * steady);
}

TEST_CASE("where the ramp of an unconverged tick is long over, what still fades goes on fading") {
  // Ticks that offer no contact fade at the rate of every decision, for 0.1 s here; one that is not solved for then
  // comes in between.
  const Preset preset = sphere_preset(0.005, Method::robust);
  RenderedState rendered;
  rendered.has = 1;
  rendered.force_n = {0.0, 0.0, 2.0};
  rendered.cld_m = 0.006;
  TickState state;
  state.rendered = rendered;
  state.has_previous = state.has_converged = 1;
  state.last_converged_s = 0.0;
  state.last_t_s = 0.050;
  state.last_position = pressed(51, 2e-3).finger.position;
  TickInput input = pressed(51, 2e-3);
  input.unready = true;
  Stepper stepper(scene_of({0.002, 0.010}, 180.0));
  const TickOutput out = stepper.step(preset, input, state);
  CHECK(out.status == TickStatus::unconverged);
  CHECK(out.force_n.z == approx(2.0 - 20.0 * kPeriod));
  CHECK(out.cld_m == approx(0.006 - 16.0 * preset.display.travel_m * kPeriod));
}
