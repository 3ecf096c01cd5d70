#include "devices/gate/energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

double stored_energy(const RenderedWall& wall) noexcept {
  if (wall.stiffness_n_per_m <= 0.0) return 0.0;
  const double rendered = std::min(wall.asked_n, wall.limit_n);
  // Beyond the limit the force stays, and so does its work per way: as far again as the spring would have gone.
  const double beyond = wall.limit_n * (std::min(wall.asked_n, kMostAsked * wall.limit_n) - rendered);
  return wall.share * (0.5 * rendered * rendered + beyond) / wall.stiffness_n_per_m;
}

// --- Force over time -----------------------------------------------------------------------------------

void ForceHistory::add(const Vec3& force_n, double dt_s) noexcept {
  const Mark& last = marks_[newest_];
  const Mark now{last.t_s + dt_s, last.impulse_ns + force_n * dt_s};
  newest_ = (newest_ + 1) % kKept;
  marks_[newest_] = now;
  count_ = std::min(count_ + 1, kKept);
  last_n_ = force_n;
}

Vec3 ForceHistory::impulse_at(double t_s) const noexcept {
  const Mark* later = &marks_[newest_];
  for (std::size_t i = 1; i < count_; ++i) {
    const Mark* mark = &marks_[(newest_ + kKept - i) % kKept];
    if (mark->t_s <= t_s) {
      const double share = (t_s - mark->t_s) / (later->t_s - mark->t_s);
      return mark->impulse_ns + std::min(1.0, share) * (later->impulse_ns - mark->impulse_ns);
    }
    later = mark;
  }
  return later->impulse_ns;
}

Vec3 ForceHistory::mean(double from_s, double to_s) const noexcept {
  from_s = std::max(from_s, marks_[(newest_ + kKept + 1 - count_) % kKept].t_s);
  to_s = std::min(to_s, marks_[newest_].t_s);
  constexpr double kShortest_s = 1e-7;  // rounding of the clocks
  return to_s - from_s > kShortest_s ? (impulse_at(to_s) - impulse_at(from_s)) / (to_s - from_s) : last_n_;
}

// --- Energy --------------------------------------------------------------------------------------------

double EnergyWatch::natural_power(const Step& step) noexcept {
  const double follow = 1.0 - std::exp(-2.0 * std::numbers::pi * kVoluntary_hz * step.dt_s);
  velocity_m_per_s_ += follow * (step.moved_m / step.dt_s - velocity_m_per_s_);
  const double speed = std::sqrt(glm::dot(velocity_m_per_s_, velocity_m_per_s_));
  return 0.5 * step.wall.stiffness_n_per_m * (step.hold_s * speed + step.resolution_m) * speed;
}

void EnergyWatch::move_credit(const Step& step, double work_j) noexcept {
  const double stored_j = stored_energy(step.wall);
  ceiling_j_ = std::max(stored_j, stored_j + (ceiling_j_ - stored_j) * std::exp(-step.dt_s / kForget_s));
  ceiling_j_ += step.declared_j;
  credit_j_ += step.declared_j + natural_power(step) * step.dt_s - work_j;
  made_in_j_[bin_] += std::max(0.0, -credit_j_);
  credit_j_ = std::clamp(credit_j_, 0.0, ceiling_j_ + kMargin_j);
}

// A period lasts from one turn, from output to input, to the next.
void EnergyWatch::find_period(double work_j, double dt_s) noexcept {
  since_turn_s_ = std::min(since_turn_s_ + dt_s, kLongest_s);
  if (work_j > 0.0) {
    out_j_ += work_j;
    if (out_j_ > kTurn_j) going_out_ = true;
    if (going_out_) in_j_ = 0.0;
  } else {
    in_j_ -= work_j;
    if (in_j_ <= kTurn_j) return;
    out_j_ = 0.0;
    if (!going_out_) return;
    going_out_ = false;
    next_window_s_ = since_turn_s_ < kLongest_s ? std::clamp(2.0 * since_turn_s_, kWindow_s, kLongest_s) : kWindow_s;
    since_turn_s_ = 0.0;
  }
}

void EnergyWatch::next_bin() noexcept {
  bin_ = (bin_ + 1) % kBins;
  made_in_j_[bin_] = older_j_ = 0.0;
  window_s_ = next_window_s_;
  const auto bins = static_cast<std::size_t>(std::lround(window_s_ / kBin_s));
  for (std::size_t i = 1; i < std::min(bins, kBins); ++i) older_j_ += made_in_j_[(bin_ + kBins - i) % kBins];
}

bool EnergyWatch::add(const Step& step) noexcept {
  const double work_j = glm::dot(step.force_n, step.moved_m);
  move_credit(step, work_j);
  find_period(work_j, step.dt_s);
  made_j_ = older_j_ + made_in_j_[bin_];
  allowed_j_ = kFloor_w * window_s_;
  in_bin_s_ += step.dt_s;
  if (in_bin_s_ >= kBin_s) {
    in_bin_s_ = std::fmod(in_bin_s_, kBin_s);
    next_bin();
  }
  return made_j_ > allowed_j_;
}

}  // namespace tangent
