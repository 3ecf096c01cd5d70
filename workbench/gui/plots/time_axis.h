// The time range that all plots share, in ticks. Pure arithmetic; the plots draw it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tangent {

class TimeAxis {
 public:
  static constexpr double kLeastSpan = 8.0;  ///< ticks

  double from() const { return to_ - span_; }
  double to() const { return to_; }
  double span() const { return span_; }
  bool following() const { return following_; }

  double tick_at(double x, double left, double width) const { return from() + (x - left) / width * span_; }
  double x_at(double tick, double left, double width) const { return left + (tick - from()) / span_ * width; }

  /// Follows the newest tick again, at the current zoom.
  void follow() { following_ = true; }
  void hold() { following_ = false; }

  /// Call once per frame with the available ticks: moves a following axis and limits the span to `longest`.
  void update(std::uint64_t first, std::uint64_t end, double longest) {
    longest_ = std::max(longest, kLeastSpan);
    span_ = std::clamp(span_, kLeastSpan, longest_);
    first_ = static_cast<double>(first);
    end_ = static_cast<double>(end);
    if (following_) to_ = end_;
  }

  /// Multiplies the span and keeps the tick `about` in place; a following axis keeps its right end instead.
  void zoom(double factor, double about) {
    const double span = std::clamp(span_ * factor, kLeastSpan, longest_);
    if (!following_) to_ = about + (to_ - about) * (span / span_);
    span_ = span;
  }
  /// Pans and stops following.
  void pan(double ticks) {
    following_ = false;
    to_ = std::clamp(to_ + ticks, first_ + 0.1 * span_, end_ + 0.9 * span_);
  }
  void show(double from, double to) {
    following_ = false;
    span_ = std::clamp(to - from, kLeastSpan, longest_);
    to_ = 0.5 * (from + to) + 0.5 * span_;
  }
  void show_all() { show(first_, std::max(end_, first_ + kLeastSpan)); }
  void set_span(double ticks) { span_ = std::clamp(ticks, kLeastSpan, longest_); }
  /// Pans just enough to bring the tick into view.
  void reveal(double tick) {
    if (tick >= from() && tick <= to_) return;
    following_ = false;
    to_ = tick + 0.5 * span_;
  }

 private:
  double to_ = 0.0, span_ = 5000.0;
  double first_ = 0.0, end_ = 0.0, longest_ = 1e9;
  bool following_ = true;
};

}  // namespace tangent
