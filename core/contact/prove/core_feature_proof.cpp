#include "core/contact/prove/core_feature_proof.h"

#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/core_crease_proof.h"
#include "core/contact/prove/depth_margin.h"
#include "core/contact/prove/feature_nets.h"
#include "core/mesh/vertex_ring.h"
#include "core/surface/patch_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace tangent {
namespace {

/// A corner of which nothing is known as a whole is halved so often, until so much was looked at: a solve costs as much
/// as ten such looks.
constexpr int kCornerHalvings = 6, kMostTests = 24;

/// Of the margin that would be enough: what is excluded for that is not looked at for more.
constexpr double kEnoughShare = 0.1;

/// By how far the part is outside the core: a contact there has p(N) - S = lambda N with |lambda| above that. Nor can
/// it be below -that where every plane of the part lies less deep in the finger; so the contact ranks behind it.
double margin_by_distance(const FingerCore& core, const SurfaceBounds& part, const RankBound& bound) {
  const double cosine = part.normals.cos_half;
  const Vec3 to_part = part.middle - core.centre();
  const double distance2 = glm::dot(to_part, to_part);
  if (!(cosine > 0.1) || !(distance2 > 0.0)) return 0.0;
  const auto outside = [&](const Vec3& direction) {
    return glm::dot(to_part, direction) - glm::dot(part.half, glm::abs(direction)) - core.half_width(direction);
  };
  const Vec3 axis = part.normals.axis;
  const Vec3 sideways = to_part - glm::dot(to_part, axis) * axis;
  double apart = outside(to_part / std::sqrt(distance2));
  if (glm::dot(sideways, sideways) > 1e-6 * distance2) apart = std::max(apart, outside(unit(sideways)));
  if (!(apart > 0.0)) return 0.0;
  const double over = glm::dot(core.support(axis).point - part.middle, axis) - glm::dot(part.half, glm::abs(axis));
  const double clear = (apart + std::min(0.0, over) / cosine) / (1.0 + 1.0 / cosine);
  return std::max(0.0, std::min(clear, bound.way_to(core.reach_m() - core.ball_m() + apart)));
}

/// By how far the part is outside the whole finger: as far as that is over the reach the finger may go.
double margin_by_rank(const FingerCore& core, const Vec3& middle, const Vec3& half, const RankBound& bound) {
  const double outside = core.rank_outside(core.apart_m(middle, half));
  return std::min(outside - core.reach_m(), bound.way_to(outside));
}

bool is_enough(double margin, double enough_m) { return margin > 0.0 && margin >= enough_m; }

/// Once it is `enough_m`, no more is asked for.
double margin_by_touch(const FingerCore& core, const SurfaceBounds& part, const RankBound& bound, double enough_m) {
  const double margin = touch_margin(core, part, enough_m);
  return is_enough(margin, enough_m) ? margin : std::max(margin, margin_by_distance(core, part, bound));
}

double margin_of(const FingerCore& core, const SurfaceBounds& part, const RankBound& bound, double enough_m) {
  const double margin =
      std::max(margin_by_rank(core, part.middle, part.half, bound), margin_by_depth(core, part.normals, bound));
  return is_enough(margin, enough_m) ? margin : std::max(margin, margin_by_touch(core, part, bound, enough_m));
}

double margin_of_crease(const FingerCore& core, const CreaseNet& crease, const RankBound& bound, double enough_m,
                        bool glance, int& tests) {
  ++tests;
  const Box box = crease.box();
  const Vec3 middle = box.centre(), extent = 0.5 * box.size();
  const NormalCone cone = crease.cone();
  double margin = std::max(margin_by_rank(core, middle, extent, bound), margin_by_depth(core, cone, bound));
  if (!is_enough(margin, enough_m)) margin = std::max(margin, crease_margin(core, crease, enough_m, glance, tests));
  if (!is_enough(margin, kEnoughShare * enough_m))
    margin = std::max(margin, margin_by_touch(core, {middle, extent, cone}, bound, enough_m));
  return margin;
}

/// The least of the margins of a triangle of normals, halved where nothing is known; 0 where one may be a contact's.
double margin_of_corner(const FingerCore& core, const NormalTriangle& part, const RankBound& bound, double enough_m,
                        int halvings, int& tests) {
  ++tests;
  const double margin = margin_of(core, part.bounds(), bound, enough_m);
  if (margin > 0.0 || halvings == 0 || tests >= kMostTests) return margin;
  double least = std::numeric_limits<double>::max();
  for (const NormalTriangle& half : part.halves()) {
    least = std::min(least, margin_of_corner(core, half, bound, std::min(enough_m, least), halvings - 1, tests));
    if (!(least > 0.0)) return 0.0;
  }
  return least;
}

/// Whether all creases that meet at a vertex are hollow: none can rest on it.
bool is_hollow_vertex(ContactContext& context, std::uint32_t t, std::uint32_t corner) {
  const ContactMesh& mesh = context.cache.mesh();
  bool hollow = true;
  around_vertex(mesh, t, corner, [&](std::uint32_t at, std::uint32_t k) {
    const EdgeKind kind = mesh.edge_kind(at, k);
    hollow = hollow && mesh.edge_kind(at, (k + 2) % 3) != EdgeKind::boundary &&
             (kind == EdgeKind::smooth ||
              (kind == EdgeKind::crease && is_hollow(crease_net(context.cache, context.settings.normal_form, at, k))));
  });
  return hollow;
}

/// Boundaries there have none.
double vertex_margin(ContactContext& context, const FingerCore& core, std::uint32_t t, std::uint32_t corner,
                     const RankBound& bound, double enough_m, bool glance, int& looks) {
  const ContactMesh& mesh = context.cache.mesh();
  ++looks;
  double margin = margin_by_rank(core, mesh.position(t, corner), Vec3(0.0), bound);
  if (is_enough(margin, enough_m)) return margin;
  const std::optional<VertexNormals> normals = VertexNormals::around(mesh, t, corner);
  const NormalCone cone = normals ? normals->cone() : NormalCone{};
  const SurfaceBounds bounds{mesh.position(t, corner), Vec3(0.0), cone};
  const std::optional<CreaseNet> arc = normals ? normals->arc() : std::nullopt;
  margin = std::max(margin, margin_by_depth(core, cone, bound));
  if (arc && !is_enough(margin, enough_m))
    margin = std::max(margin, crease_margin(core, *arc, enough_m, glance, looks));
  if (!is_enough(margin, arc ? kEnoughShare * enough_m : enough_m))
    margin = std::max(margin, margin_by_touch(core, bounds, bound, enough_m));
  if (margin > 0.0 || !normals) return margin;
  if (is_hollow_vertex(context, t, corner)) return std::numeric_limits<double>::max();
  if (arc || glance) return margin;
  std::array<NormalTriangle, VertexNormals::kMost> parts;
  const std::size_t count = normals->parts(parts);
  if (count > 0) margin = std::numeric_limits<double>::max();
  for (const NormalTriangle& part : std::span(parts).first(count)) {
    margin = std::min(margin, margin_of_corner(core, part, bound, std::min(enough_m, margin), kCornerHalvings, looks));
    if (!(margin > 0.0)) return 0.0;
  }
  return margin;
}

double edge_margin(ContactContext& context, const FingerCore& core, std::uint32_t t, std::uint32_t k,
                   const RankBound& bound, double enough_m, bool glance, int& tests) {
  const ContactMesh& mesh = context.cache.mesh();
  if (mesh.edge_kind(t, k) == EdgeKind::boundary) {  // which has any normal
    Box box;
    for (const Vec3& p : edge_points(context.cache.patch(t, context.settings.normal_form), k)) box.include(p);
    return margin_by_rank(core, box.centre(), 0.5 * box.size(), bound);
  }
  const CreaseNet crease = crease_net(context.cache, context.settings.normal_form, t, k);
  if (is_hollow(crease)) return std::numeric_limits<double>::max();
  return margin_of_crease(core, crease, bound, enough_m, glance, tests);
}

}  // namespace

FeatureExclusion exclude_feature_by_core(ContactContext& context, const FingerCore& core,
                                         const TriangleFeature& feature, const RankBound& bound, double enough_m,
                                         bool glance) {
  const std::uint32_t t = feature.triangle, k = feature.number;
  FeatureExclusion result;
  const double margin = feature.is_corner ? vertex_margin(context, core, t, k, bound, enough_m, glance, result.tests)
                                          : edge_margin(context, core, t, k, bound, enough_m, glance, result.tests);
  result.margin_m = certain_margin(margin, rounding_of_margin(core.centre(), context.cache.mesh().position(t, 0)));
  return result;
}

}  // namespace tangent
