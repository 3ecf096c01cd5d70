// The two clocks of a trial: since the first touch, and only while touching (Doxon et al. 5.3.6.5).
#pragma once

#include <algorithm>
#include <cmath>

namespace tangent::experiment {

class TrialClock {
 public:
  /// Begins a stimulus.
  void begin(double t_s) { *this = TrialClock(t_s); }
  void advance(double t_s, bool touching) {
    const double passed = std::max(0.0, t_s - last_s_);
    last_s_ = std::max(last_s_, t_s);
    if (touched_) since_touch_s_ += passed;
    if (touched_ && was_touching_) touching_s_ += passed;
    touched_ = touched_ || touching;
    was_touching_ = touching;
  }
  TrialClock() = default;
  bool touched() const { return touched_; }
  bool touching() const { return was_touching_; }
  /// In whole microseconds, so that a row does not hang on when the program was started.
  double began_s() const { return micro(began_s_); }
  double since_touch_s() const { return micro(since_touch_s_); }
  double touching_s() const { return micro(touching_s_); }

 private:
  static double micro(double s) { return std::round(s * 1e6) / 1e6; }
  explicit TrialClock(double t_s) : began_s_(t_s), last_s_(t_s) {}
  double began_s_ = 0.0, last_s_ = 0.0;
  double since_touch_s_ = 0.0, touching_s_ = 0.0;
  bool touched_ = false, was_touching_ = false;
};

}  // namespace tangent::experiment
