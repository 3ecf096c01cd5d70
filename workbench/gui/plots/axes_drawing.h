// Grid, labels and title of the plots without a time axis: X-Y, spectrum, histogram.
#pragma once

#include "workbench/gui/plots/plot_area.h"
#include "workbench/gui/widgets/ui_context.h"

#include <string>

namespace tangent {

struct PlainAxis {
  double low = 0.0, high = 1.0;  ///< in displayed units; log: both > 0
  bool log = false;
  std::string label;  ///< with its unit
  /// 0 at the lower end, 1 at the upper.
  double share(double value) const;
  double value_at(double share) const;
};

struct PlainPlot {
  PlotArea area;
  PlainAxis x, y;
  ImVec2 at(double x_value, double y_value) const {
    return {area.min.x + static_cast<float>(x.share(x_value)) * area.width(),
            area.max.y - static_cast<float>(y.share(y_value)) * area.height()};
  }
};

/// Leaves room for labels left and below, and a heading above.
PlotArea plain_area(const UiContext& ui, ImVec2 pos, ImVec2 size);
void draw_axes(const UiContext& ui, const PlainPlot& plot);

}  // namespace tangent
