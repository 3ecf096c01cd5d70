#include "core/contact/follow/follow.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/hollow.h"
#include "core/contact/nearest_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {
namespace {

/// Whether the normal has turned by more than the finger's motion explains: about a contact h from its centre it turns
/// by the way over h.
bool has_turned_over(const ContactContext& context, const TrackedPlane& kept, const IterationResult& now) {
  const double cosine = glm::dot(kept.normal, now.plane.normal);
  if (cosine >= kJumpCosine) return false;
  if (context.moved_m > context.hystereses_m(kLeapOfFinger)) return true;
  const double explained = 2.0 * context.moved_m / std::abs(now.contact.height_m);
  return std::acos(std::max(-1.0, cosine)) - std::acos(kJumpCosine) > explained;
}

/// Whether the depth along the normal, which the force follows, has changed by more than the motion explains.
bool has_leapt_in_depth(const ContactContext& context, const TrackedPlane& kept, const IterationResult& now) {
  const double before = contact_on_plane(context.finger, context.pose, kept.point, kept.normal).penetration_m;
  const Vec3 change = std::max(0.0, now.contact.penetration_m) * now.plane.normal - std::max(0.0, before) * kept.normal;
  const double explained = 2.0 * context.moved_m + context.hystereses_m(kLeapDepth);
  return glm::dot(change, change) > explained * explained;
}

bool can_be_in_hollow(const ContactContext& context, const TrackedPlane& kept) {
  return context.settings.method == Method::robust && is_round(context.finger) &&
         glm::dot(context.pose.position - kept.point, kept.normal) < 0.0;
}

/// Where the kept contact was on a face, and was lost: whether it has come into a hollow crease or corner of that.
bool came_into_hollow(ContactContext& context, const TrackedPlane& kept, IterationResult& result) {
  const ContactMesh& mesh = context.cache.mesh();
  const NearestHit hit = closest_on_triangle(mesh, kept.triangle, context.pose.position);
  const int evaluations = result.evaluations;
  if (!find_in_hollow(context, feature_at(mesh, kept.triangle, hit.u, hit.v), result)) return false;
  result.evaluations += evaluations;
  return true;
}

/// Where the kept contact was on a hollow crease: whether it has gone on to the face on one of its sides.
bool went_on_to_side(ContactContext& context, const TrackedPlane& kept, IterationResult& result) {
  const ContactMesh& mesh = context.cache.mesh();
  const double f = edge_fraction(kept.side, kept.u, kept.v);
  const EdgeLink other = mesh.across(kept.triangle, kept.side);
  const std::pair<std::uint32_t, Vec2> sides[] = {{kept.triangle, edge_point_uv(kept.side, f)},
                                                  {other.triangle, edge_point_uv(other.edge, 1.0 - f)}};
  int evaluations = result.evaluations;
  for (const auto& [triangle, uv] : sides) {
    iterate(context, place_on_face(triangle, uv.x, uv.y), kTrackBudget, result);
    result.evaluations = evaluations += result.evaluations;
    if (result.converged() && result.contact.height_m < 0.0) return true;
  }
  return false;
}

/// The contact in or beside a hollow crease or corner, where following without them has failed.
bool follow_hollow(ContactContext& context, const TrackedPlane& kept, IterationResult& result) {
  if (!can_be_in_hollow(context, kept)) return false;
  if (came_into_hollow(context, kept, result)) return true;
  return kept.feature == Feature::edge &&
         context.cache.mesh().edge_kind(kept.triangle, kept.side) == EdgeKind::crease &&
         went_on_to_side(context, kept, result);
}

}  // namespace

Followed follow(ContactContext& context, const TrackedPlane& kept, bool sample_is_kept, IterationResult& result) {
  const bool robust = context.settings.method == Method::robust;
  const int limit = context.settings.max_iterations;
  if (kept.feature != Feature::face && can_be_in_hollow(context, kept) && find_in_hollow(context, kept, result))
    return has_leapt_in_depth(context, kept, result) ? Followed::branched : Followed::held;
  iterate_kept(context, kept, sample_is_kept, robust ? std::min(kTrackBudget, limit) : limit, result);
  if (!result.converged() && !follow_hollow(context, kept, result)) return Followed::lost;
  if (!has_turned_over(context, kept, result)) {
    // The motion may explain as much as that, but over a fold the contact has leapt all the same.
    const bool over_fold = result.met_unstable && glm::dot(kept.normal, result.plane.normal) < kJumpCosine;
    return over_fold || has_leapt_in_depth(context, kept, result) ? Followed::branched : Followed::held;
  }
  if (result.met_unstable || !robust) return Followed::branched;
  if (context.trace) context.trace->amend_last(StopReason::leapt);
  return Followed::lost;
}

}  // namespace tangent
