#include "core/contact/prove/triangle_proof.h"

#include "core/contact/nearest_triangles.h"
#include "core/finger/plane_contact.h"

#include <algorithm>

namespace tangent {
namespace {

/// corner_exclusion for other than round fingers: seen from the support point p(A) of the triangle's mean normal A, the
/// contact p(N) + depth N of a normal N of the patch misses the line along N by no more than p moves between A and N.
double exclude_unround(ContactContext& context, std::uint32_t t) {
  constexpr double kRoom = 1.5;  // from the corner normals to any normal of the patch
  const ContactMesh& mesh = context.cache.mesh();
  const auto n = mesh.normals(t);
  const Vec3 sum = n[0] + n[1] + n[2];
  if (glm::dot(sum, sum) < 4.0) return 0.0;
  const Vec3 support = support_point(context.finger, context.pose, unit(sum));
  double moves = 0.0;
  for (const Vec3& normal : n)
    moves = std::max(moves, glm::distance(support, support_point(context.finger, context.pose, normal)));
  return std::max(0.0, corner_exclusion(mesh, t, support) - kRoom * moves);
}

/// Nothing proved; a solve had best start at the triangle's closest point.
PatchExclusion unknown(const ContactContext& context, std::uint32_t t) {
  const NearestHit hit = closest_on_triangle(context.cache.mesh(), t, context.pose.position);
  PatchExclusion nothing;
  nothing.u = hit.u;
  nothing.v = hit.v;
  return nothing;
}

PatchExclusion exclude_face(ContactContext& context, std::uint32_t t, double bound_m, double enough_m) {
  const Vec3& centre = context.pose.position;
  PatchExclusion proof;
  const double at_once = corner_exclusion(context.cache.mesh(), t, centre);
  if (at_once > 0.0 && at_once >= enough_m) {
    proof.margin_m = at_once;
    proof.possible = false;
    return proof;
  }
  proof = exclude_contact(context.cache.patch(t, context.settings.normal_form), centre, enough_m);
  proof.margin_m = std::max({at_once, proof.margin_m, 0.5 * (proof.least_height_m - bound_m)});
  if (proof.margin_m > 0.0) proof.possible = false;
  return proof;
}

}  // namespace

PatchExclusion exclude_triangle(ContactContext& context, std::uint32_t t, double bound_m, double enough_m,
                                FeatureMemory* memory) {
  const ContactMesh& mesh = context.cache.mesh();
  if (!is_round(context.finger)) {
    if (!mesh.interior(t)) return unknown(context, t);
    PatchExclusion proof;
    proof.margin_m = exclude_unround(context, t);
    proof.possible = false;
    return proof.margin_m > 0.0 ? proof : unknown(context, t);
  }
  PatchExclusion proof = exclude_face(context, t, bound_m, enough_m);
  if (mesh.interior(t)) return proof;
  const double features = exclude_feature_contacts(context.cache, t, context.settings.normal_form,
                                                   context.pose.position, bound_m, enough_m, memory);
  if (features <= 0.0) return unknown(context, t);
  proof.margin_m = std::min(proof.margin_m, features);
  return proof;
}

}  // namespace tangent
