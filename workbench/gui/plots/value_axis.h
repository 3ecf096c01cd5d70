// The vertical axis of a plot. It fits itself to the visible values: it grows at once when values would be cut off, and
// shrinks only when there is much room to spare, so that it does not jump.
#pragma once

#include "workbench/gui/plots/channel_store.h"

namespace tangent {

class ValueAxis {
 public:
  double low() const { return low_; }
  double high() const { return high_; }
  bool automatic() const { return automatic_; }
  bool fitted() const { return !(automatic_ && fresh_); }  ///< false: no values were seen yet

  /// `visible` in displayed units. Linear: includes zero when `with_zero`. `floor`: lower limit of a log axis; values
  /// at or below 0 are drawn at the lower edge.
  void fit_linear(const MinMax& visible, bool with_zero);
  void fit_log(const MinMax& visible, double floor);
  /// Zooms by hand about a value; stops automatic fitting.
  void zoom(double factor, double about, bool log);
  /// By hand: pans down by a share of the axis (negative: up), or sets a range. Stops automatic fitting.
  void pan(double share, bool log);
  void show(double low, double high);
  void set_automatic() { automatic_ = fresh_ = true; }
  /// As it was, also where it had fitted itself and has kept more room since than it would take anew.
  void take_up(double low, double high, bool automatic);

  /// 0 at the lower edge, 1 at the upper.
  double share(double value, bool log) const;
  double value_at(double share, bool log) const;

 private:
  void take(double low, double high, double used_span, double span);
  double low_ = 0.0, high_ = 1.0;
  bool automatic_ = true;
  bool fresh_ = true;  ///< not fitted yet: takes the first range as it is
};

}  // namespace tangent
