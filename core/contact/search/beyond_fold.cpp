#include "core/contact/search/beyond_fold.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/follow/walk.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Of the triangle, in its parameters: the first step to the side; each further one is twice as long.
constexpr double kFirstStep = 1.0 / 16.0;
constexpr int kSteps = 9;

/// Parameters of the direction in which M's lesser eigenvalue pulls a contact on, the larger of them 1; of complex ones
/// the direction of their mean.
Vec2 weakest_direction(const SurfaceSample& s, const ContactJacobian& j, const Stability& stability) {
  const double half = 0.5 * stability.trace;
  const double least = half - std::sqrt(std::max(0.0, half * half - stability.det));
  const auto in_plane = [&](const Vec3& x) { return x - glm::dot(x, s.normal) * s.normal; };
  const Vec3 u = in_plane(j.xa - least * s.point_u), v = in_plane(j.xb - least * s.point_v);
  const Vec3& along = glm::dot(u, u) > glm::dot(v, v) ? u : v;
  const Vec2 a(-glm::dot(v, along), glm::dot(u, along));
  const double size = std::max(std::abs(a.x), std::abs(a.y));
  return size > 0.0 ? a / size : Vec2(1.0, 0.0);
}

}  // namespace

bool iterate_beyond_fold(ContactContext& context, const IterationResult& unstable, double sign, int budget,
                         IterationResult& result) {
  result.evaluations = 0;
  if (unstable.plane.feature != Feature::face) return false;
  const SurfaceSample& s = unstable.sample;
  const ContactJacobian here = contact_jacobian(context.finger, context.pose, s, unstable.contact);
  Vec2 step = sign * kFirstStep * weakest_direction(s, here, face_stability(s, here));
  for (int i = 0; i < kSteps; ++i, step *= 2.0) {
    const WalkResult walk = walk_face(context.cache.mesh(), unstable.plane.triangle, unstable.plane.u, unstable.plane.v,
                                      step.x, step.y, std::min(kMostTrackedCrossings, context.most_crossings));
    if (walk.lost) return false;
    const bool left = walk.place.feature != Feature::face;
    if (!left) {
      SurfaceSample there;
      context.cache.sample(walk.place.triangle, context.settings.normal_form, walk.place.u, walk.place.v, there);
      ++result.evaluations;
      const PlaneContact c = contact_on_plane(context.finger, context.pose, there.point, there.normal);
      if (!trusts_newton(face_stability(there, contact_jacobian(context.finger, context.pose, there, c)))) continue;
    }
    const int so_far = result.evaluations;
    iterate(context, walk.place, budget, result);
    result.evaluations += so_far;
    return result.converged();
  }
  return false;
}

}  // namespace tangent
