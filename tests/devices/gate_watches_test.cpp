#include "devices/gate_watches.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace tangent;

namespace {

constexpr double kDt = 1e-3;

/// Work measured for x = A sin(w t) against a spring K with a delay of `delay_s`, over a second.
double shake_work(double amplitude, double hz, double stiffness, double delay_s) {
  ShakeWatch watch;
  const double w = 2.0 * std::numbers::pi * hz;
  const auto x = [&](double t) { return amplitude * std::sin(w * t); };
  double most = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const double t = i * kDt, middle = t - 0.5 * kDt;
    watch.add(Vec3(0, 0, -stiffness * x(middle - delay_s)), Vec3(0, 0, x(t) - x(t - kDt)), kDt);
    if (i > 500) most = std::max(most, watch.work_j());
  }
  return most;
}

}  // namespace

TEST_CASE("peak force may be held for the stated time, then the motors' heat allows the continuous force") {
  ForceBudget budget;
  CHECK(budget.allowed(8.5, 1.4) == 8.5);
  double seconds_at_peak = 0.0;
  for (int i = 0; i < 60'000; ++i) {
    const double force = budget.allowed(8.5, 1.4);
    if (force == 8.5) seconds_at_peak += kDt;
    budget.spend(force, 8.5, 1.4, kDt);
  }
  CHECK(seconds_at_peak == doctest::Approx(0.5 * ForceBudget::kPeakHold_s).epsilon(0.01));
  CHECK(budget.allowed(8.5, 1.4) == doctest::Approx(1.4).epsilon(0.01));
  for (int i = 0; i < 200'000; ++i) budget.spend(0.0, 8.5, 1.4, kDt);  // cools
  CHECK(budget.allowed(8.5, 1.4) == 8.5);
  for (int i = 0; i < 600'000; ++i) budget.spend(1.4, 8.5, 1.4, kDt);  // for ever
  CHECK(budget.allowed(8.5, 1.4) == 8.5);
  CHECK(ForceBudget{}.allowed(8.5, 0.0) == 8.5);  // not known: no limit of its own
}

TEST_CASE("a spring does no work on a shaking hand, a late one does, as much as theory says") {
  const double spring = shake_work(0.5e-3, 40.0, 1000.0, 0.0);
  const double late = shake_work(0.5e-3, 40.0, 1000.0, 1.5e-3);
  // Net power K A^2 w sin(w T) / 2 accumulates over the memory; the stored energy K A^2 / 2 oscillates on top of it.
  const double w = 2.0 * std::numbers::pi * 40.0;
  const double net = 0.5 * 1000.0 * 0.25e-6 * w * std::sin(w * 1.5e-3) * ShakeWatch::kMemory_s;
  CHECK(spring < 0.5 * 1000.0 * 0.25e-6);
  CHECK(late == doctest::Approx(net).epsilon(0.1));
  CHECK(late > 10.0 * spring);
}

TEST_CASE("pressing slowly, holding and letting go is not shaking") {
  ShakeWatch watch;
  double last = 0.0, most = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double depth = 3e-3 * 0.5 * (1.0 - std::cos(std::numbers::pi * i * kDt));  // in and out in 2 s
    watch.add(Vec3(0, 0, 1500.0 * depth), Vec3(0, 0, -(depth - last)), kDt);
    last = depth;
    most = std::max(most, watch.work_j());
  }
  CHECK(most < 0.1 * ShakeWatch::kSoften_j);
}

TEST_CASE("the share of force that passes falls from one to nothing between softening and stop") {
  ShakeWatch watch;
  double last = 1.0;
  for (int i = 0; i < 200 && !watch.stop(); ++i) {
    const double sign = (i / 5) % 2 == 0 ? 1.0 : -1.0;  // pushes the way it moves, 100 times a second
    watch.add(Vec3(0, 0, 2.0 * sign), Vec3(0, 0, 0.1e-3 * sign), kDt);
    CHECK(watch.share() <= last);
    CHECK((watch.share() < 1.0) == (watch.work_j() > ShakeWatch::kSoften_j));
    last = watch.share();
  }
  CHECK(watch.stop());
  CHECK(watch.share() == 0.0);
}

TEST_CASE("a position that freezes while moving is found after 20 ticks - rest, dithering and turning are not") {
  const auto quantised = [](double x) { return Vec3(std::round(x / 0.03e-3) * 0.03e-3, 0, 0); };
  FrozenPositionWatch frozen;
  int found = -1;
  for (int i = 0; i < 200 && found < 0; ++i) {
    if (frozen.add(quantised(0.1 * kDt * std::min(i, 100)))) found = i;  // 100 mm/s until tick 100
  }
  CHECK(found == 120);

  FrozenPositionWatch resting;
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(resting.add(quantised(0.01)));
  FrozenPositionWatch dithering;
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(dithering.add(quantised(i < 2500 ? 0.03e-3 * (i % 2) : 0.0)));
  FrozenPositionWatch turning;  // a hand that reverses at 5 m/s^2
  for (int i = 0; i < 5000; ++i) CHECK_FALSE(turning.add(quantised(5.0 / 1600.0 * std::sin(40.0 * i * kDt))));
}

TEST_CASE("a roller far from its target that does not move is found after 50 ticks, one near it never") {
  FrozenDisplayWatch frozen;
  int ticks = 1;
  while (!frozen.add(1e-3, 3e-3)) REQUIRE(++ticks < 100);
  CHECK(ticks == 51);  // the first reading has nothing to be compared with
  FrozenDisplayWatch near;
  for (int i = 0; i < 500; ++i) CHECK_FALSE(near.add(1e-3, 1.4e-3));
}
