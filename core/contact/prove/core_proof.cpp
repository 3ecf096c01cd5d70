#include "core/contact/prove/core_proof.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"
#include "core/contact/nearest_triangles.h"
#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tangent {
namespace {

constexpr double kSharpShare = 0.8;  // of the sharpest radius: less deep the finger does not fold over by itself

/// Of a patch's longer side: p is linear to within that, or nothing is gained by taking it for that.
constexpr double kMostOff = 0.3;

/// Control normals as a Bernstein form has them, of either normal form.
std::array<Vec3, 6> bernstein_normals(const PnPatch& patch) {
  std::array<Vec3, 6> n = patch.normals;
  for (std::size_t i = n110; i <= n101; ++i) n[i] *= 0.5 * patch.mixed_weight;
  return n;
}

/// The cone of the directions of some vectors about their sum.
NormalCone cone_of(std::span<const Vec3> normals) {
  Vec3 sum(0.0);
  for (const Vec3& n : normals) sum += n;
  const double length2 = glm::dot(sum, sum);
  if (length2 < 1e-6) return {};
  NormalCone cone{sum / std::sqrt(length2), 1.0};
  for (const Vec3& n : normals)
    cone.cos_half = std::min(cone.cos_half, glm::dot(n, cone.axis) / std::sqrt(std::max(1e-300, glm::dot(n, n))));
  return cone;
}

SurfaceBounds bounds_of(std::span<const Vec3> points, const NormalCone& cone) {
  Box box;
  for (const Vec3& p : points) box.include(p);
  return {box.centre(), 0.5 * box.size(), cone};
}

/// p(n) about the axis of a patch's normals: D n, and how far that is off.
struct LinearCore {
  CoreSupport support;
  double off_m = std::numeric_limits<double>::infinity();  ///< |e| at most
  double least_length_m = 0.0;                             ///< |A N| at least
};

LinearCore linear_core(const FingerCore& core, const std::array<Vec3, 6>& normals, const Vec3& axis) {
  LinearCore l;
  l.support = core.support(axis);
  double step = 0.0, slope2 = 0.0, least = 1.0;
  for (const Vec3& n : normals) {
    const double along = glm::dot(n, axis);
    if (!(along > 0.3)) return l;
    const Vec3 tau = n / along - axis;
    const Vec3 moved = core.derivative(l.support, tau);
    step = std::max(step, core.half_width(tau));
    slope2 = std::max(slope2, glm::dot(moved, moved));
    least = std::min(least, along);
  }
  l.off_m = core.longest_m() * core.bend(l.support, step) + (1.0 - least) * std::sqrt(slope2);
  l.least_length_m = l.support.length - step;
  return l;
}

/// The patch S - D n, raised so that its heights are ranks: by the reach less the ball along n.
PnPatch patch_less_core(const PnPatch& patch, const std::array<Vec3, 6>& n, const FingerCore& core,
                        const CoreSupport& support) {
  const double raise = core.reach_m() - core.ball_m();
  std::array<Vec3, 6> d;
  for (std::size_t i = 0; i < 6; ++i) d[i] = core.derivative(support, n[i]) + raise * n[i];
  PnPatch less = patch;
  const auto lower = [&](ControlPoint b, const Vec3& by) { less.offsets[b] -= by; };
  lower(b300, d[n200]);
  lower(b030, d[n020]);
  lower(b003, d[n002]);
  lower(b210, (d[n200] + 2.0 * d[n110]) / 3.0);
  lower(b120, (d[n020] + 2.0 * d[n110]) / 3.0);
  lower(b021, (d[n020] + 2.0 * d[n011]) / 3.0);
  lower(b012, (d[n002] + 2.0 * d[n011]) / 3.0);
  lower(b102, (d[n002] + 2.0 * d[n101]) / 3.0);
  lower(b201, (d[n200] + 2.0 * d[n101]) / 3.0);
  lower(b111, (d[n110] + d[n011] + d[n101]) / 3.0);
  return less;
}

/// Of a place that may hold a contact, known but for `off_m`: its point, and the least rank that the contact may have.
void rank_place(const ContactContext& context, const FingerCore& core, const PnPatch& patch, double off_m,
                PatchExclusion& proof) {
  proof.point = evaluate_point(patch, proof.u, proof.v);
  const PlaneContact c =
      contact_on_plane(context.finger, context.pose, proof.point, evaluate_normal(patch, proof.u, proof.v));
  const double wrong = off_m * off_m / std::max(1e-12, core.sharpest_m());
  proof.height_m = std::max(0.0, contact_rank(context.finger, c) - wrong);
}

/// A solve had best start where the core's support for the triangle's middle normal is nearest.
PatchExclusion no_proof(const ContactContext& context, const FingerCore& core, std::uint32_t t) {
  const ContactMesh& mesh = context.cache.mesh();
  const auto n = mesh.normals(t);
  const Vec3 sum = n[0] + n[1] + n[2];
  const bool leans = glm::dot(sum, sum) > 1e-6;
  const NearestHit hit = closest_on_triangle(mesh, t, leans ? core.support(unit(sum)).point : core.centre());
  PatchExclusion nothing;
  nothing.u = hit.u;
  nothing.v = hit.v;
  return nothing;
}

/// corner_exclusion for these fingers: seen from p(A), A the triangle's mean normal, the contact of a normal of the
/// patch misses the line along it by no more than p moves between the two.
double corner_exclusion_by_core(const ContactMesh& mesh, const FingerCore& core, std::uint32_t t) {
  constexpr double kRoom = 1.5;  // from the corner normals to any normal of the patch
  const auto n = mesh.normals(t);
  const Vec3 sum = n[0] + n[1] + n[2];
  if (glm::dot(sum, sum) < 4.0) return 0.0;
  const CoreSupport support = core.support(unit(sum));
  double moves = 0.0, least_length = support.length;
  for (const Vec3& normal : n) {
    const CoreSupport there = core.support(normal);
    moves = std::max(moves, glm::distance(support.point, there.point));
    least_length = std::min(least_length, there.length);
  }
  const double room = corner_exclusion(mesh, t, support.point) - kRoom * moves;
  return core.way_within(core.longest_m(), least_length, room);
}

}  // namespace

PatchExclusion exclude_face_by_core(ContactContext& context, const FingerCore& core, std::uint32_t t,
                                    const RankBound& bound, double enough_m) {
  PatchExclusion proof;
  proof.possible = false;
  // A first look tells whether there is a contact now, but not well enough for how long there will be none.
  if (!(enough_m > 0.0)) proof.margin_m = corner_exclusion_by_core(context.cache.mesh(), core, t);
  if (proof.margin_m > 0.0) return proof;
  const PnPatch& patch = context.cache.patch(t, context.settings.normal_form);
  const std::array<Vec3, 6> normals = bernstein_normals(patch);
  const NormalCone cone = cone_of(normals);
  std::array<Vec3, 10> points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = patch.control_point(i);
  const double at_once = std::max(proof.margin_m, touch_margin(core, bounds_of(points, cone)));
  proof.margin_m = at_once;
  if (at_once > 0.0 && at_once >= enough_m) return proof;
  const LinearCore linear = linear_core(core, normals, cone.axis);
  const double size2 =
      std::max(glm::dot(patch.offsets[b030], patch.offsets[b030]), glm::dot(patch.offsets[b003], patch.offsets[b003]));
  if (!(linear.off_m * linear.off_m < kMostOff * kMostOff * size2))
    return at_once > 0.0 ? proof : no_proof(context, core, t);

  const StandIn stands_for{{patch.offsets[b030], patch.offsets[b003]}, linear.off_m};
  proof = exclude_contact(patch_less_core(patch, normals, core, linear.support), linear.support.point, 2.0 * enough_m,
                          stands_for);
  const double least_rank = proof.least_height_m - linear.off_m;
  const double shallow = least_rank > core.lever_m() ? bound.way_to(least_rank) : 0.0;
  const double by_slide =
      proof.margin_m > 0.0 ? core.way_within(core.longest_m(), linear.least_length_m, proof.margin_m) : 0.0;
  proof.margin_m = std::max({at_once, shallow, by_slide});
  if (proof.margin_m > 0.0) proof.possible = false;
  if (proof.possible) rank_place(context, core, patch, linear.off_m, proof);
  return proof;
}

PatchExclusion exclude_by_core(ContactContext& context, const FingerCore& core, std::uint32_t t, const RankBound& bound,
                               double enough_m) {
  const ContactMesh& mesh = context.cache.mesh();
  if (!mesh.interior(t)) return no_proof(context, core, t);
  return exclude_face_by_core(context, core, t, bound, enough_m);
}

bool can_ask_steady(const FingerCore& core, double rank_m) {
  return core.reach_m() - rank_m < kSharpShare * core.sharpest_m();
}

}  // namespace tangent
