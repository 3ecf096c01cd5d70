#include "devices/base/repeated_reading.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>

using namespace tangent;

namespace {

/// A hand that aims here and there, and runs into stops, read in steps, with a velocity over a window of 20 ms.
class ReadHand {
 public:
  ReadHand(double step_m, unsigned seed) : step_m_(step_m), random_(seed) {}

  void go_on() {
    if (random_() % 200 == 0) aim_m_per_s_ = 0.5 * (static_cast<double>(random_() % 2001) / 1000.0 - 1.0);
    if (random_() % 400 == 0) aim_m_per_s_ = speed_m_per_s_ = 0.0;  // a stop
    speed_m_per_s_ += 0.1 * (aim_m_per_s_ - speed_m_per_s_);
    at_m_ += speed_m_per_s_ * 1e-3;
    past_m_[++t_ % past_m_.size()] = position().x;
  }
  Vec3 position() const { return {step_m_ * std::round(at_m_ / step_m_), 0.0, 0.0}; }
  Vec3 velocity() const { return {(position().x - past_m_[(t_ + 1) % past_m_.size()]) / 20e-3, 0.0, 0.0}; }

 private:
  double step_m_, at_m_ = 0.0, speed_m_per_s_ = 0.0, aim_m_per_s_ = 0.0;
  std::array<double, 21> past_m_{};
  std::size_t t_ = 0;
  std::mt19937 random_;
};

}  // namespace

TEST_CASE("no hand that stops, creeps or is read twice is taken for a repeated reading") {
  for (const double step_m : {1e-6, 10e-6, 60e-6}) {
    ReadHand hand(step_m, 7);
    RepeatedReading watch;
    int alarms = 0, repeats = 0;
    for (int i = 0; i < 200'000; ++i) {
      if (i % 20 != 0) hand.go_on();  // the device's clock is slower: every 20th reading is the one before
      repeats += i % 20 == 0;
      alarms += watch.add(hand.position(), hand.velocity(), 1e-3);
    }
    CHECK(repeats == 10'000);
    CHECK(alarms == 0);
  }
}

TEST_CASE("a reading that repeats at 0.1 m/s or more is found by its third repeat, and slower by its way") {
  struct {
    double m_per_s;
    int most;  // repeats; 0: never within 1,000
  } const cases[] = {{0.0, 0}, {1e-4, 0}, {0.01, 31}, {0.05, 7}, {0.11, 3}, {1.0, 3}};
  for (const auto& c : cases) {
    CAPTURE(c.m_per_s);
    RepeatedReading watch;
    int found = 0;
    for (int repeat = 0; repeat <= 1000 && found == 0; ++repeat)
      if (watch.add(Vec3(0.01, 0.02, 0.03), Vec3(0.0, c.m_per_s, 0.0), 1e-3)) found = repeat;
    CHECK(found <= c.most);
    CHECK((found > 0) == (c.most > 0));
  }
}
