#include "workbench/recording/motion_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

static_assert(kRoughBands_hz.size() == 3);

double size_of(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

HighPass::HighPass(double cutoff_hz, double rate_hz) {
  const double w = std::tan(std::numbers::pi * std::min(cutoff_hz / rate_hz, 0.45));
  const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
  gain_ = norm;
  a1_ = 2.0 * (w * w - 1.0) * norm;
  a2_ = (1.0 - std::numbers::sqrt2 * w + w * w) * norm;
}

double HighPass::operator()(double x) {
  if (!begun_) x1_ = x2_ = x;
  begun_ = true;
  const double y = gain_ * (x - 2.0 * x1_ + x2_) - a1_ * y1_ - a2_ * y2_;
  x2_ = x1_;
  x1_ = x;
  y2_ = y1_;
  y1_ = y;
  return y;
}

void Spread::add(double value) {
  const double place = value > 1.0 ? 32.0 * std::log2(value) : 0.0;
  ++counts_[static_cast<std::size_t>(std::min(place, 2047.0))];
  ++count_;
}

double Spread::quantile(double q) const {
  const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < counts_.size() && count_ > 0; ++i) {
    below += counts_[i];
    if (below >= rank) return std::exp2((static_cast<double>(i) + 0.5) / 32.0);
  }
  return 0.0;
}

MotionCounter::Roughness::Roughness(double from_hz, double rate_hz)
    : filters{HighPass(from_hz, rate_hz), HighPass(from_hz, rate_hz), HighPass(from_hz, rate_hz),
              HighPass(from_hz, rate_hz)} {}

void MotionCounter::Roughness::add(const TickOutput& output) {
  for (int axis = 0; axis < 3; ++axis) {
    const double y = filters[static_cast<std::size_t>(axis)](output.force_n[axis]);
    force += y * y;
  }
  const double y = filters[3](output.cld_m);
  display += y * y;
}

MotionCounter::MotionCounter(double rate_hz)
    : rough_{Roughness(kRoughFrom_hz, rate_hz), Roughness(kRoughBands_hz[0], rate_hz),
             Roughness(kRoughBands_hz[1], rate_hz), Roughness(kRoughBands_hz[2], rate_hz)},
      spectrum_(rate_hz) {}

void MotionCounter::add(const TickOutput& output, double ns, bool follows) {
  ++n_.ticks;
  if (!is_converged(output.status)) ++n_.unconverged;
  error_ += output.error_m;
  n_.worst_error_m = std::max(n_.worst_error_m, output.error_m);
  iterations_ += output.iterations;
  n_.most_iterations = std::max(n_.most_iterations, static_cast<double>(output.iterations));
  ++by_iterations_[static_cast<std::size_t>(std::clamp(output.iterations, 0, 4095))];
  times_.add(ns);
  const double force_n = size_of(output.force_n);
  force_sum_ += force_n;
  n_.most_force_n = std::max(n_.most_force_n, force_n);
  ++n_.events[static_cast<std::size_t>(output.event)];
  add_roughness(output, follows);
}

void MotionCounter::add_roughness(const TickOutput& output, bool follows) {
  if (follows) {
    const double force_n = size_of(output.force_n - last_force_), display_m = std::abs(output.cld_m - last_display_);
    force_jumps_ += force_n * force_n;
    display_jumps_ += display_m * display_m;
    n_.worst_force_jump_n = std::max(n_.worst_force_jump_n, force_n);
    n_.worst_display_jump_m = std::max(n_.worst_display_jump_m, display_m);
  }
  last_force_ = output.force_n;
  last_display_ = output.cld_m;
  for (Roughness& rough : rough_) rough.add(output);
  spectrum_.add(output.force_n, output.cld_m, follows);
}

MotionNumbers MotionCounter::done() const {
  MotionNumbers n = n_;
  if (n.ticks == 0) return n;
  n.spectrum = spectrum_.done();
  const auto count = static_cast<double>(n.ticks);
  n.mean_error_m = error_ / count;
  n.mean_iterations = iterations_ / count;
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < by_iterations_.size(); ++i) {
    below += by_iterations_[i];
    if (static_cast<double>(below) < 0.99 * count) continue;
    n.p99_iterations = static_cast<double>(i);
    break;
  }
  n.p50_ns = times_.quantile(0.5);
  n.p99_ns = times_.quantile(0.99);
  n.mean_force_n = force_sum_ / count;
  n.rms_force_jump_n = std::sqrt(force_jumps_ / count);
  n.rms_display_jump_m = std::sqrt(display_jumps_ / count);
  n.force_above_20hz_n = std::sqrt(rough_[0].force / count);
  n.display_above_20hz_m = std::sqrt(rough_[0].display / count);
  for (std::size_t i = 0; i < kRoughBands_hz.size(); ++i) {
    n.force_above_n[i] = std::sqrt(rough_[1 + i].force / count);
    n.display_above_m[i] = std::sqrt(rough_[1 + i].display / count);
  }
  return n;
}

}  // namespace tangent
