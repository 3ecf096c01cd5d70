#include "workbench/bringup/guided_hand.h"

#include "workbench/bringup/axis_check.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr double kMotion_s = 0.8, kSettled_s = 1.2, kPause_s = 0.2;

/// T. Flash and N. Hogan, The Coordination of Arm Movements, J. Neuroscience 5(7), 1985: least jerk.
double least_jerk(double s) { return s * s * s * (10.0 + s * (6.0 * s - 15.0)); }
double least_jerk_speed(double s) { return s * s * (30.0 + s * (30.0 * s - 60.0)); }

}  // namespace

void GuidedHand::follow(const BringUpView& view, double dt_s) noexcept {
  if (hand_ == nullptr) return;
  since_s_ += dt_s;
  if (view.questions != question_) {
    question_ = view.questions;
    since_s_ = 0.0;
    from_m_ = to_m_;
    if (view.ask == BringUpAsk::move)
      to_m_ += glm::conjugate(frame_.rotation) * (view.move_m * asked_direction(view.axis));
  }
  const bool moves = from_m_ != to_m_;
  const double s = std::min(1.0, since_s_ / kMotion_s);
  HandTarget target;
  target.position_m = from_m_ + least_jerk(s) * (to_m_ - from_m_);
  target.velocity_m_per_s = least_jerk_speed(s) / kMotion_s * (to_m_ - from_m_);
  hand_->lead(target);
  settled_ = since_s_ >= (moves && view.ask == BringUpAsk::move ? kSettled_s : kPause_s);
}

void GuidedHand::follow(const CalibrationView& view, double dt_s) noexcept {
  if (hand_ == nullptr) return;
  since_s_ = view.questions == question_ ? since_s_ + dt_s : 0.0;
  question_ = view.questions;
  hand_->lead({});
  settled_ = since_s_ >= kPause_s;
}

}  // namespace tangent
