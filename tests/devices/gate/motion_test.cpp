#include "devices/gate/motion.h"

#include <doctest/doctest.h>

#include "devices/simulated/simulated_force_device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

using namespace tangent;

namespace {

/// Telemetry of a finger on its way: sampled at its own rate, with a gap now and then; the servo sees the newest.
struct Telemetry {
  double rate_hz, gap_s, speed_m_per_s;
  double leap_at_s = 1e9, leap_m = 0.0;
  double gap_every_s = 0.1;

  /// The newest sample at time t.
  double sampled_at(double t) const {
    double at = std::floor(t * rate_hz + 1e-6) / rate_hz;
    // In the gap at the end of each stretch nothing new arrives.
    const double into = std::fmod(at, gap_every_s), begins = gap_every_s - gap_s;
    if (gap_s > 0.0 && into > begins) at -= into - std::floor(begins * rate_hz) / rate_hz;
    return std::max(0.0, at);
  }
  double position(double t) const { return speed_m_per_s * t + (t >= leap_at_s ? leap_m : 0.0); }
};

/// Time at which a leap is reported, s; below 0: none in a second.
double leap_found(const Telemetry& telemetry, double servo_hz) {
  MotionWatch watch;
  for (int tick = 1; tick <= servo_hz; ++tick) {
    const double t = tick / servo_hz, at = telemetry.sampled_at(t);
    const MotionStep step = watch.add(Vec3(telemetry.position(at), 0, 0), t - at, 1.0 / servo_hz, {10.0, 1e-3});
    if (step.leapt) return t;
  }
  return -1.0;
}

/// How long readings stay exactly the same right after a motion that the watch for frozen ones takes for one.
struct StillRuns {
  static constexpr std::array<int, 5> kAtLeast{3, 5, 10, 15, 20};
  std::array<int, 5> runs{};
  int longest = 0;

  void add(const Vec3& position_m) {
    const bool moved = !past.empty() && position_m != past.back();
    if (moved || past.size() < FrozenPositionWatch::kReadings) {
      end();
    } else if (++still == 1) {
      const auto count = std::count(moves.begin(), moves.end(), true);
      was_moving = count >= static_cast<long>(FrozenPositionWatch::kMovingReadings) &&
                   glm::length(past.back() - past.front()) >= FrozenPositionWatch::kMoved_m;
    }
    past.push_back(position_m);
    moves.push_back(moved);
    if (past.size() > FrozenPositionWatch::kReadings) past.erase(past.begin()), moves.erase(moves.begin());
  }
  void end() {
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i] += was_moving && still >= kAtLeast[i];
    if (was_moving) longest = std::max(longest, still);
    still = 0;
    was_moving = false;
  }

 private:
  std::vector<Vec3> past;
  std::vector<bool> moves;
  int still = 0;
  bool was_moving = false;
};

/// A simulated hand strokes to places at random, in 0.1 to 0.5 s each as hands do (least jerk), and rests between;
/// along x there may be a wall in its way, `wall_n_per_m` stiff.
StillRuns still_runs(double step_m, double wall_n_per_m, std::uint64_t seed, int strokes) {
  SimulatedForceOptions options;
  options.seed = seed;
  options.position_step_m = step_m;
  options.friction_n = 0.0;
  SimulatedForceDevice device(options);
  if (!device.open()) return {};
  ForceSample sample = device.exchange({.request = DeviceRequest::home}, 1e-3);
  for (int i = 0; i < 200; ++i) sample = device.exchange({}, 1e-3);
  std::mt19937_64 random(seed);
  const auto any = [&](double from, double to) { return from + (to - from) * 0x1p-64 * static_cast<double>(random()); };
  StillRuns seen;
  Vec3 from(0.0);
  for (int stroke = 0; stroke < strokes; ++stroke) {
    const Vec3 to(any(-0.05, 0.05), any(-0.05, 0.05), any(-0.05, 0.05));
    const double takes_s = any(0.1, 0.5), rests_s = any(0.0, 0.3);
    for (double t = 0.0; t < takes_s + rests_s; t += 1e-3) {
      const double u = std::min(1.0, t / takes_s);
      const double way = u * u * u * (10.0 + u * (6.0 * u - 15.0)),
                   speed = 30.0 * u * u * (1.0 - u) * (1.0 - u) / takes_s;
      device.lead({.position_m = from + way * (to - from), .velocity_m_per_s = speed * (to - from)});
      const double force = std::clamp(-wall_n_per_m * sample.position_m.x, 0.0, 8.0);
      sample = device.exchange({.force_n = Vec3(force, 0.0, 0.0)}, 1e-3);
      seen.add(sample.position_m);
    }
    from = to;
  }
  seen.end();
  return seen;
}

}  // namespace

TEST_CASE("measure: how long a healthy device reads the same in the middle of a motion" * doctest::skip()) {
  constexpr int kStrokes = 2000;
  std::puts("| encoder steps | wall | 3 or more | 5 | 10 | 15 | 20 | longest |");
  for (const double step_m : {30e-6, 63.5e-6}) {
    for (const double wall_n_per_m : {0.0, 1000.0, 3000.0}) {
      const StillRuns seen = still_runs(step_m, wall_n_per_m, 7, kStrokes);
      std::printf("| %.1f um | %.0f N/m |", 1e6 * step_m, wall_n_per_m);
      for (const int runs : seen.runs) std::printf(" %d |", runs);
      std::printf(" %d |\n", seen.longest);
    }
  }
}

TEST_CASE("motion is judged by the samples' own time: servo rate x telemetry rate x gap x speed") {
  int cases = 0;
  for (const double servo : {100.0, 300.0, 1000.0, 3000.0, 10'000.0}) {
    for (const double telemetry : {200.0, 500.0, 1000.0, 4000.0}) {
      for (const double gap : {0.0, 2e-3, 5e-3, 9e-3}) {
        for (const double speed : {0.0, 0.1, 1.0, 3.0, 8.0}) {
          CAPTURE(servo);
          CAPTURE(telemetry);
          CAPTURE(gap);
          CAPTURE(speed);
          CHECK(leap_found({telemetry, gap, speed}, servo) < 0.0);
          // A leap of twice what the fastest hand can do in the time between two samples, at 10 m/s.
          const double apart = std::max({1.0 / servo, 1.0 / telemetry, gap, 1e-3}) + 1.0 / telemetry;
          const Telemetry leaping{telemetry, gap, speed, 0.55, 20.0 * apart};
          const double found = leap_found(leaping, servo);
          CHECK(found >= 0.55 - 1e-9);
          CHECK(found <= 0.55 + apart + gap + 1.0 / servo + 1e-9);
          ++cases;
        }
      }
    }
  }
  CHECK(cases == 400);
}

TEST_CASE("a sample that comes again is not fresh, and one whose tick began late is not faster") {
  MotionWatch watch;
  const MotionLimits limits{10.0, 1e-3};
  CHECK(watch.add(Vec3(0.0), 0.2e-3, 1e-3, limits).fresh);
  CHECK_FALSE(watch.add(Vec3(0.0), 1.2e-3, 1e-3, limits).fresh);
  const MotionStep late = watch.add(Vec3(4e-3, 0, 0), 1.9e-3, 1e-3, limits);  // 0.3 ms by its age, 1 ms in truth
  CHECK(late.fresh);
  CHECK_FALSE(late.leapt);
  CHECK(late.moved_m.x == 4e-3);
  CHECK(watch.add(Vec3(25e-3, 0, 0), 1.9e-3, 1e-3, limits).leapt);
}

TEST_CASE("readings nearer than a millisecond count as one") {
  MotionWatch watch;
  int counted = 0, fresh = 0;
  for (int i = 1; i <= 10'000; ++i) {
    const MotionStep step = watch.add(Vec3(1e-6 * i, 0, 0), 0.0, 1e-4, {});
    counted += step.counted;
    fresh += step.fresh;
  }
  CHECK(fresh == 10'000);
  CHECK(counted >= 1000);
  CHECK(counted <= 1300);
}

TEST_CASE("a position that freezes while moving is found after 20 readings - rest, dithering and turning are not") {
  constexpr double dt = 1e-3;
  const auto quantised = [](double x) { return Vec3(std::round(x / 0.03e-3) * 0.03e-3, 0, 0); };
  FrozenPositionWatch frozen;
  int found = -1;
  for (int i = 0; i < 200 && found < 0; ++i) {
    if (frozen.add(quantised(0.1 * dt * std::min(i, 100)))) found = i;  // 100 mm/s until reading 100
  }
  CHECK(found == 120);

  FrozenPositionWatch resting;
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(resting.add(quantised(0.01)));
  FrozenPositionWatch dithering;
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(dithering.add(quantised(i < 2500 ? 0.03e-3 * (i % 2) : 0.0)));
  FrozenPositionWatch turning;  // a hand that reverses at 5 m/s^2
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(turning.add(quantised(5.0 / 1600.0 * std::sin(40.0 * i * dt))));
}

TEST_CASE("a roller far from its target that does not move is found after 50 readings, one near it never") {
  FrozenDisplayWatch frozen;
  int readings = 1;
  while (!frozen.add(1e-3, 3e-3)) REQUIRE(++readings < 100);
  CHECK(readings == 51);  // the first reading has nothing to be compared with
  FrozenDisplayWatch near;
  for (int i = 0; i < 500; ++i) CHECK_FALSE(near.add(1e-3, 1.4e-3));
}
