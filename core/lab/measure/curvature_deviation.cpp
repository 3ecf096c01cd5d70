#include "core/lab/measure/curvature_deviation.h"

#include <algorithm>
#include <cmath>

namespace tangent {

CurvatureDeviation curvature_deviation(int segments, ArcPlacement placement, LocalCentre centre, int samples) {
  const auto curve = PlanarCurve::build(make_paper_arc(segments, placement));
  CurvatureDeviation out;
  if (!curve) return out;
  const std::uint32_t middle = curve->patch_count() / 2;
  double sum = 0.0, way = 0.0;
  for (int i = 0; i < samples; ++i) {
    const LineSample s = curve->sample(middle, centre, (i + 0.5) / samples);
    const double deviation = rendered_curvature(s) * kPaperArcRadius - 1.0, step = glm::length(s.place_t);
    sum += deviation * deviation * step;
    way += step;
    out.largest = std::max(out.largest, std::abs(deviation));
  }
  out.rms = std::sqrt(sum / way);
  return out;
}

}  // namespace tangent
