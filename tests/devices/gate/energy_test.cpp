#include "devices/gate/energy.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kPeak_n = 8.5;

/// A surface pushed by a motion that is given: depth(t), positive inside. The force is computed from a tick's depth and
/// acts from then on, `delay_ticks` later.
struct PushedWall {
  double rate_hz = 1000.0;
  double stiffness = 1000.0, damping = 0.0;
  int delay_ticks = 0;
  std::function<double(double)> depth_m = {};

  double power_w = 0.0;     ///< mean net output of the run
  double worst = 0.0;       ///< largest share of what is allowed
  double stopped_s = -1.0;  ///< when; below 0: never
  EnergyWatch watch = {};

  void run(double seconds) {
    const double dt = 1.0 / rate_hz;
    std::deque<double> force(static_cast<std::size_t>(delay_ticks) + 1, 0.0);
    double last = depth_m(0.0), velocity = 0.0, asked = 0.0;
    const double follow = 1.0 - std::exp(-2.0 * std::numbers::pi * 50.0 * dt);
    for (int i = 1; i <= seconds * rate_hz; ++i) {
      const double now = depth_m(i * dt), moved = last - now;  // outward
      power_w += force.front() * moved / seconds;
      const bool stop = watch.add({.force_n = Vec3(0, 0, force.front()),
                                   .moved_m = Vec3(0, 0, moved),
                                   .dt_s = dt,
                                   .hold_s = dt,
                                   .wall = {stiffness, asked, kPeak_n, 1.0}});
      if (stop && stopped_s < 0.0) stopped_s = i * dt;
      worst = std::max(worst, watch.made_j() / watch.allowed_j());
      velocity += follow * ((now - last) / dt - velocity);
      asked = now > 0.0 ? std::max(0.0, stiffness * now + damping * velocity) : 0.0;
      force.push_back(std::min(asked, kPeak_n));
      force.pop_front();
      last = now;
    }
  }
};

std::function<double(double)> swinging(double middle_m, double amplitude_m, double hz) {
  return [=](double t) { return middle_m - amplitude_m * std::cos(2.0 * std::numbers::pi * hz * t); };
}

}  // namespace

TEST_CASE("springs and damped walls at every rate are left alone, tapped, pressed and pressed beyond the peak force") {
  int cases = 0;
  double worst = 0.0;
  for (const double rate : {100.0, 300.0, 1000.0, 3000.0, 10'000.0}) {
    for (const double stiffness : {100.0, 800.0, 3500.0}) {
      for (const double damping : {0.0, 5.0, 20.0}) {
        for (const auto& [middle, amplitude, hz] :
             {std::array{0.0, 5e-3, 0.5}, std::array{0.0, 3e-3, 2.0}, std::array{2e-3, 1.9e-3, 4.0},
              std::array{8e-3, 10e-3, 1.0}, std::array{-1e-3, 2e-3, 6.0}}) {
          PushedWall wall{.rate_hz = rate, .stiffness = stiffness, .damping = damping};
          wall.depth_m = swinging(middle, amplitude, hz);
          wall.run(4.0);
          CAPTURE(rate);
          CAPTURE(stiffness);
          CAPTURE(damping);
          CAPTURE(hz);
          CHECK(wall.stopped_s < 0.0);
          worst = std::max(worst, wall.worst);
          ++cases;
        }
      }
    }
  }
  MESSAGE(cases << " walls: at most " << worst << " of what is allowed");
  CHECK(worst < 0.9);
}

TEST_CASE(
    "a loop that puts out more than 10 mW is stopped in half a second or two periods, up to a quarter of the rate") {
  int stopped = 0;
  for (const double rate : {500.0, 1000.0, 4000.0, 10'000.0}) {
    for (const double hz : {1.0, 2.0, 5.0, 12.0, 25.0, 60.0, 125.0}) {
      if (hz > 0.25 * rate) continue;
      for (const double wanted_w : {15e-3, 44e-3, 50e-3, 0.2}) {
        // A spring that is late: K A^2 w sin(w delay) / 2; the delay that makes the power, if one does.
        const double stiffness = 1500.0, amplitude = 1.5e-3, w = 2.0 * std::numbers::pi * hz;
        const double ratio = wanted_w / (0.5 * stiffness * amplitude * amplitude * w);
        const double delay_s = ratio < 1.0 ? std::asin(ratio) / w : 0.0;
        PushedWall wall{.rate_hz = rate, .stiffness = stiffness};
        wall.delay_ticks = static_cast<int>(std::ceil(delay_s * rate));
        wall.depth_m = swinging(1.6e-3, amplitude, hz);
        wall.run(4.0);
        if (wall.power_w < wanted_w) continue;  // no delay makes this power
        CAPTURE(rate);
        CAPTURE(hz);
        CAPTURE(wall.power_w);
        CHECK(wall.stopped_s > 0.0);
        CHECK(wall.stopped_s <= std::max(0.5, 2.0 / hz) + 1.0 / rate);
        ++stopped;
      }
    }
  }
  MESSAGE(stopped << " loops stopped");
  CHECK(stopped > 60);
}

TEST_CASE("credit is what the hand put in, no more than the surface can return, and gone out of contact") {
  EnergyWatch watch;
  const double dt = 1e-3;
  const RenderedWall wall{1000.0, 2.0, kPeak_n, 1.0};  // 2 mm deep: 2 mJ
  CHECK(stored_energy(wall) == approx(2e-3));
  CHECK(stored_energy({1000.0, 2.0, kPeak_n, 0.25}) == approx(0.5e-3));
  CHECK(stored_energy({1000.0, 10.0, 4.0, 1.0}) == approx(0.5 * 16e-3 + 4.0 * 6e-3));
  CHECK(stored_energy({0.0, 10.0, 4.0, 1.0}) == 0.0);
  // Rubbing against friction for a minute takes 12 J from the hand ...
  for (int i = 0; i < 60'000; ++i)
    watch.add({.force_n = Vec3(2, 0, 0), .moved_m = Vec3(-1e-4, 0, 0), .dt_s = dt, .hold_s = dt, .wall = wall});
  CHECK(watch.credit_j() <= 2e-3 + EnergyWatch::kMargin_j);
  // ... and buys no kick: 2 N over 5 mm.
  bool stopped = false;
  for (int i = 0; i < 50; ++i)
    stopped =
        watch.add({.force_n = Vec3(2, 0, 0), .moved_m = Vec3(1e-4, 0, 0), .dt_s = dt, .hold_s = dt, .wall = wall}) ||
        stopped;
  CHECK(stopped);

  EnergyWatch left;
  for (int i = 0; i < 100; ++i)
    left.add({.force_n = Vec3(2, 0, 0), .moved_m = Vec3(-1e-4, 0, 0), .dt_s = dt, .hold_s = dt, .wall = wall});
  CHECK(left.credit_j() > 2e-3);
  for (int i = 0; i < 2000; ++i) left.add({.dt_s = dt, .hold_s = dt, .wall = {1000.0, 0.0, kPeak_n, 1.0}});
  CHECK(left.credit_j() <= 1.01 * EnergyWatch::kMargin_j);
}

TEST_CASE(
    "a force that pushes the way the finger moves is stopped, and one that declares its work is not until beyond") {
  const auto pushed = [](double declared_w) {
    EnergyWatch watch;
    for (int i = 1; i <= 3000; ++i) {  // 0.5 N at 0.2 m/s: 100 mW
      if (watch.add({.force_n = Vec3(0.5, 0, 0),
                     .moved_m = Vec3(0.2e-3, 0, 0),
                     .dt_s = 1e-3,
                     .hold_s = 1e-3,
                     .declared_j = declared_w * 1e-3,
                     .wall = {1000.0, 0.5, kPeak_n, 1.0}}))
        return i;
    }
    return 0;
  };
  CHECK(pushed(0.0) > 0);
  CHECK(pushed(0.0) < 200);
  CHECK(pushed(0.1) == 0);
  CHECK(pushed(0.05) > 0);
}

TEST_CASE("observed energy: the hand's while it presses, none after it left a spring") {
  PushedWall wall{.stiffness = 800.0};
  wall.depth_m = [](double t) { return 3e-3 * std::min(1.0, t / 0.5); };
  wall.run(0.5);
  CHECK(wall.watch.net_j() == approx(-0.5 * 800.0 * 9e-6).epsilon(0.05));
}

TEST_CASE("the mean force of a past interval is that of the ticks in it") {
  ForceHistory history;
  CHECK(history.mean(0.0, 0.0) == Vec3(0.0));
  for (int i = 0; i < 1000; ++i) history.add(Vec3(i, 0, 0), 1e-3);  // i N in the tick that ends at i + 1 ms
  CHECK(history.mean(0.999, 1.0).x == approx(999.0));
  CHECK(history.mean(0.990, 0.992).x == approx(990.5));
  CHECK(history.mean(0.9905, 0.9910).x == approx(990.0));
  CHECK(history.mean(0.9, 1.0).x == approx(949.5));
  CHECK(history.mean(2.0, 3.0).x == 999.0);                         // nothing is known of then
  CHECK(history.mean(0.0, 1.0).x == approx(872.0).epsilon(0.001));  // as far back as it goes
}
