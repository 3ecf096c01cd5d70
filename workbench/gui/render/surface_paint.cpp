#include "workbench/gui/render/surface_paint.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {
double on_axis(const MapPaint& paint, double value) {
  return paint.logarithmic ? std::log(std::max(value, 1e-30)) : value;
}
}  // namespace

double map_share(const MapPaint& paint, double value) {
  const double low = on_axis(paint, paint.low), high = on_axis(paint, paint.high);
  return (on_axis(paint, value) - low) / (high - low);
}

double map_value_at(const MapPaint& paint, double share) {
  const double low = on_axis(paint, paint.low), high = on_axis(paint, paint.high);
  const double at = low + share * (high - low);
  return paint.logarithmic ? std::exp(at) : at;
}

Rgba map_colour(const MapPaint& paint, double value) {
  const double share = std::clamp(map_share(paint, value), 0.0, 1.0);
  return colour_at(paint.colours, static_cast<float>(paint.reversed ? 1.0 - share : share));
}

}  // namespace tangent
