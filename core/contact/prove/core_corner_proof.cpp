#include "core/contact/prove/core_corner_proof.h"

#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/corner_misses.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {

CoreControlPoints::CoreControlPoints(const FingerCore& core, const std::array<Vec3, 6>& normals) {
  std::array<Vec3, 6> y;
  for (std::size_t i = 0; i < 6; ++i) {
    const CoreSupport support = core.support(normals[i]);
    points[i] = support.point;
    y[i] = support.length * support.direction;
  }
  const Vec3 middle = (y[0] + y[1] + y[2]) / 3.0;
  const double length = std::sqrt(glm::dot(middle, middle));
  if (!(length > 0.0)) return;
  double least = length * length, widest2 = 0.0, least_lean = 1.0, most_lean = -1.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 off = y[i] - middle;
    widest2 = std::max(widest2, glm::dot(off, off));
    least = std::min(least, glm::dot(y[i], middle));
    const double lean = glm::dot(normals[i], core.long_axis());
    least_lean = std::min(least_lean, lean);
    most_lean = std::max(most_lean, lean);
  }
  least_length_m = least / length;
  if (!(least_length_m > 0.0)) return;
  constexpr double kHalfSecond = 0.57735026918962584;  // 1/sqrt(3)
  const double longest = core.longest_m();
  off_m = kHalfSecond * longest * widest2 / (least_length_m * least_length_m);
  const double to_end = std::max(least_lean, -most_lean);
  if (!(to_end > 0.0)) return;
  const double slim = core.width_m() / (longest * to_end);
  off_m = std::min(off_m, slim * (0.5 * longest * slim + 2.0 * core.width_m()));
}

namespace {

/// Cosine: where all normals lean that much to one end of a thin core, the end is all that they touch.
constexpr double kLeast = 0.15;

/// Of a core as thin as a capsule's, whatever the normals: p is on its long axis, but for its width, and the misses are
/// those of the centre but for what the axis is beside the direction that they are seen along.
double exclusion_by_axis(PatchCache& cache, std::uint32_t t, NormalForm form, const FingerCore& core, double enough_m) {
  const Vec3 &centre = core.centre(), &axis = core.long_axis();
  CornerMisses misses(cache.mesh(), t, {centre, centre, centre});
  const double rounding = rounding_of_margin(centre, misses.p[0]);
  const auto seen = [&] {
    double off = 0.0;
    for (const Vec3& n : misses.n) off = std::max(off, std::abs(glm::dot(axis, glm::cross(n, misses.along))));
    off = core.longest_m() * off + core.width_m();
    if (!(misses.least() > enough_m + off + rounding)) return 0.0;
    const FaceOutline& outline = cache.outline(t, form);
    if (!outline.has_middles) return 0.0;
    for (const Vec3& n : outline.middle_normals)
      off = std::max(off, core.longest_m() * std::abs(glm::dot(axis, glm::cross(n, misses.along))) + core.width_m());
    return certain_margin(misses.clear(outline) - off, rounding);
  };
  const double at_once = seen();
  if (at_once > 0.0 && at_once >= enough_m) return at_once;
  const Vec3 sum = misses.n[0] + misses.n[1] + misses.n[2];
  const Vec3 across = axis - (glm::dot(axis, sum) / glm::dot(sum, sum)) * sum;
  const double across2 = glm::dot(across, across);
  if (!(across2 > 0.01)) return at_once;
  misses.look_along(across / std::sqrt(across2));
  return std::max(at_once, seen());
}

double exclusion_by_supports(PatchCache& cache, std::uint32_t t, NormalForm form, const FingerCore& core,
                             double enough_m) {
  const std::array<Vec3, 3> n = cache.mesh().normals(t);
  const CornerMisses misses(cache.mesh(), t,
                            {core.support(n[0]).point, core.support(n[1]).point, core.support(n[2]).point});
  const double rounding = rounding_of_margin(core.centre(), misses.p[0]);
  if (!(misses.least() > enough_m + rounding)) return 0.0;
  const FaceOutline& outline = cache.outline(t, form);
  if (!outline.has_middles) return 0.0;
  const std::array<Vec3, 3>& middle = outline.middle_normals;
  const CoreControlPoints control(core, {n[0], n[1], n[2], middle[0], middle[1], middle[2]});
  if (!(misses.least() > enough_m + control.off_m + rounding)) return 0.0;
  const double clear = misses.clear(outline, {control.points[3], control.points[4], control.points[5]});
  return core.way_within(core.longest_m(), control.least_length_m, certain_margin(clear - control.off_m, rounding));
}

}  // namespace

double corner_exclusion_by_core(PatchCache& cache, std::uint32_t t, NormalForm form, const FingerCore& core,
                                double enough_m) {
  const ContactMesh& mesh = cache.mesh();
  if (!is_thin(core)) return exclusion_by_supports(cache, t, form, core, enough_m);
  const Vec3& axis = core.long_axis();
  const double a = glm::dot(mesh.normal(t, 0), axis), b = glm::dot(mesh.normal(t, 1), axis),
               c = glm::dot(mesh.normal(t, 2), axis);
  const bool leans = std::max(std::min({a, b, c}), -std::max({a, b, c})) > kLeast;
  return leans ? exclusion_by_supports(cache, t, form, core, enough_m)
               : exclusion_by_axis(cache, t, form, core, enough_m);
}

}  // namespace tangent
