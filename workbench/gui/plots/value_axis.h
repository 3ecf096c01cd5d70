// The vertical axis of a plot: fits itself to what is visible, at once when something would be cut off and
// only reluctantly when there is room to spare, so that the picture doesn't jump about.
#pragma once

#include "workbench/gui/plots/channel_store.h"

namespace tangent {

class ValueAxis {
 public:
  double low() const { return low_; }
  double high() const { return high_; }
  bool automatic() const { return automatic_; }

  /// `visible` in displayed units. Linear: zero is kept in view when `with_zero`. `floor`: log axes end
  /// there; 0 and below are drawn at the lower edge.
  void fit_linear(const MinMax& visible, bool with_zero);
  void fit_log(const MinMax& visible, double floor);
  /// By hand, about a value; automatic fitting stops.
  void zoom(double factor, double about, bool log);
  /// By hand: down by a share of the axis (negative: up), and a range.
  void pan(double share, bool log);
  void show(double low, double high);
  void set_automatic() { automatic_ = fresh_ = true; }

  /// 0 at the lower edge, 1 at the upper.
  double share(double value, bool log) const;
  double value_at(double share, bool log) const;

 private:
  void take(double low, double high, double used_span, double span);
  double low_ = 0.0, high_ = 1.0;
  bool automatic_ = true;
  bool fresh_ = true;  ///< nothing fitted yet: take the first range as it is
};

}  // namespace tangent
