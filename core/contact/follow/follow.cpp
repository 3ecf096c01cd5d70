#include "core/contact/follow/follow.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/hollow.h"
#include "core/contact/nearest_triangles.h"

#include <algorithm>
#include <cmath>

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

/// A round finger's centre has to be behind the plane; of others it is not known, but in meshes without inner edges
/// nothing more is asked.
bool can_be_in_hollow(const ContactContext& context, const TrackedPlane& kept) {
  if (context.settings.method != Method::robust) return false;
  if (!is_round(context.finger)) return context.cache.mesh().has_concave_crease();
  return glm::dot(context.pose.position - kept.point, kept.normal) < 0.0;
}

bool is_in_hollow(const ContactContext& context, const TrackedPlane& kept) {
  return kept.feature != Feature::face && can_be_in_hollow(context, kept) && is_hollow(context.cache.mesh(), kept);
}

/// Where the kept contact was on a face, and was lost: whether it has come into a hollow crease or corner of that.
bool came_into_hollow(ContactContext& context, const TrackedPlane& kept, IterationResult& result) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3 nearest =
      is_round(context.finger) ? context.pose.position : support_point(context.finger, context.pose, kept.normal);
  const NearestHit hit = closest_on_triangle(mesh, kept.triangle, nearest);
  const int evaluations = result.evaluations;
  if (!find_in_hollow(context, feature_at(mesh, kept.triangle, hit.u, hit.v), result)) return false;
  result.evaluations += evaluations;
  return true;
}

/// Where the kept contact was on a crease: whether it has gone on to the face on one of its sides.
bool went_on_to_side(ContactContext& context, const TrackedPlane& kept, IterationResult& result) {
  int evaluations = result.evaluations;
  for (const SurfacePlace& side : sides_of(context.cache.mesh(), kept)) {
    iterate(context, side, kTrackBudget, result);
    result.evaluations = evaluations += result.evaluations;
    if (result.converged() && (result.contact.height_m < 0.0 || is_hollow(context.cache.mesh(), kept))) return true;
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
  const auto held_unless_leapt = [&] {
    return has_leapt_in_depth(context, kept, result) ? Followed::branched : Followed::held;
  };
  if (is_in_hollow(context, kept) && find_in_hollow(context, kept, result)) return held_unless_leapt();
  iterate_kept(context, kept, sample_is_kept, robust ? std::min(kTrackBudget, limit) : limit, result);
  if (!result.converged()) {
    if (!follow_hollow(context, kept, result)) return Followed::lost;
    const ContactMesh& mesh = context.cache.mesh();
    if (is_hollow(mesh, kept) || is_hollow(mesh, result.plane)) return held_unless_leapt();
  }
  if (!has_turned_over(context, kept, result)) {
    // The motion may explain as much as that, but over a fold the contact has leapt all the same.
    const bool over_fold = result.met_unstable && glm::dot(kept.normal, result.plane.normal) < kJumpCosine;
    return over_fold || has_leapt_in_depth(context, kept, result) ? Followed::branched : Followed::held;
  }
  if (result.met_unstable || !robust) return Followed::branched;
  if (context.trace) context.trace->amend_last(StopReason::leapt);
  return Followed::lost;
}

void lead(ContactContext& context, const TrackedPlane& contact, IterationResult& result) {
  if (is_in_hollow(context, contact) && find_in_hollow(context, contact, result)) return;
  iterate_kept(context, contact, false, kTrackBudget, result);
  if (result.converged() || contact.feature == Feature::face) return;
  const int evaluations = result.evaluations;
  if (find_in_hollow(context, contact, result)) result.evaluations += evaluations;
}

}  // namespace tangent
