#include "core/contact/prove/triangle_proof.h"

#include "core/contact/contact_rank.h"
#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/core_corner_proof.h"
#include "core/contact/prove/core_feature_proof.h"
#include "core/contact/prove/core_proof.h"
#include "core/contact/prove/corner_glance.h"
#include "core/contact/prove/feature_proof.h"
#include "core/finger/plane_contact.h"
#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <limits>

namespace tangent {
namespace {

/// A first look at a face with one normal all over, such as a sliver of a flat cap: a contact lies straight under the
/// centre, so it is excluded by how far that is beside the triangle, less what creases and boundaries may bulge. 0:
/// look closer.
double even_exclusion(const ContactMesh& mesh, std::uint32_t t, const Vec3& centre) {
  const Vec3& n = mesh.normal(t, 0);
  if (mesh.normal(t, 1) != n || mesh.normal(t, 2) != n) return 0.0;
  constexpr double kBulge =
      0.5;  // of an edge: its control points are within a third of it, the middle one half of that more
  double bulge = 0.0, beside = 0.0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 &p = mesh.position(t, k), along = mesh.position(t, (k + 1) % 3) - p;
    if (mesh.edge_kind(t, k) != EdgeKind::smooth) bulge = std::max(bulge, kBulge * std::sqrt(glm::dot(along, along)));
    const Vec3 out = glm::cross(along, n);
    const double length2 = glm::dot(out, out);
    const double lean = glm::dot(along, n);
    if (!(length2 > 0.0) || lean * lean > 1e-20 * length2) return 0.0;  // not the triangle's own normal
    const double side = glm::dot(mesh.position(t, (k + 2) % 3) - p, out) > 0.0 ? -1.0 : 1.0;
    beside = std::max(beside, side * glm::dot(centre - p, out) / std::sqrt(length2));
  }
  return certain_margin(beside - bulge, rounding_of_margin(centre, mesh.position(t, 0)));
}

/// On rough ground, where searches don't look far ahead, corners tell next to nothing of what a glance left.
PatchExclusion exclude_face(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m) {
  const Vec3& centre = context.pose.position;
  PatchExclusion proof;
  double at_once = even_exclusion(context.cache.mesh(), t, centre);
  if (!(enough_m > 0.0) || context.far_ahead)
    at_once = std::max(at_once, corner_exclusion(context.cache, t, context.settings.normal_form, centre));
  if (at_once > 0.0 && at_once >= kAtOnceShare * enough_m) {
    proof.margin_m = at_once;
    proof.possible = false;
    return proof;
  }
  PatchFront& front = context.cache.front(t, context.settings.normal_form);
  proof = exclude_contact(context.cache.patch(t, context.settings.normal_form), centre, enough_m,
                          context.far_ahead ? enough_m : kAtOnceShare * enough_m, bound, front);
  const double behind = bound.way_to(proof.least_height_m);
  proof.by_rank = proof.by_rank || behind > proof.margin_m;
  proof.margin_m = std::max(proof.margin_m, behind);
  if (at_once >= proof.margin_m) {
    proof.margin_m = at_once;
    proof.by_rank = false;
  }
  if (proof.margin_m > 0.0) proof.possible = false;
  return proof;
}

/// The one place of a finger on a region is where its support for the region's normal lies over it.
PatchExclusion exclude_region(ContactContext& context, std::uint32_t& t, const RankBound& bound) {
  const ContactMesh& mesh = context.cache.mesh();
  const FlatRegions& flat = mesh.flat_regions();
  const std::uint32_t region = flat.of(t);
  const Vec3 &normal = flat.normal(region), &origin = flat.origin(region);
  const bool round = is_round(context.finger);
  const CoreSupport support = round ? CoreSupport{context.pose.position, {}, 0.0} : context.core->support(normal);
  const RegionFoot foot = flat.foot(mesh, region, support.point);
  t = foot.triangle;
  PatchExclusion proof;
  proof.u = foot.u;
  proof.v = foot.v;
  const double room = 4.0 * FlatRegions::kFlat * glm::distance(support.point, origin);
  const double beside = foot.beside_m - room;
  const double behind =
      bound.way_to(contact_rank(context.finger, contact_on_plane(context.finger, context.pose, origin, normal)) - room);
  const double outside =
      round || !(beside > 0.0) ? beside : context.core->way_within(context.core->longest_m(), support.length, beside);
  proof.margin_m = std::max({0.0, outside, behind});
  proof.by_rank = behind > outside;
  if (proof.margin_m > 0.0) proof.possible = false;
  return proof;
}

/// How far a point is behind all faces around a vertex that is on no rim: so far off no contact on it is stable. Not
/// over 0: nothing is known.
double behind_corner(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner, const Vec3& point) {
  if (mesh.crowded_vertex(mesh.vertex(t, corner))) return 0.0;
  const Vec3 d = point - mesh.position(t, corner);
  double front = std::numeric_limits<double>::lowest();
  bool rim = false;
  around_vertex(mesh, t, corner, [&](std::uint32_t at, std::uint32_t k) {
    front = std::max(front, glm::dot(d, mesh.normal(at, k)));
    rim = rim || mesh.edge_kind(at, k) == EdgeKind::boundary;
  });
  return rim ? 0.0 : -front;
}

FeatureExclusion exclude_feature(ContactContext& context, const FingerCore* core, const PartOfTriangle& part,
                                 const RankBound& bound, double enough_m, bool glance) {
  const bool side = is_side(part.part);
  const TriangleFeature feature{part.triangle, side ? side_of(part.part) : corner_of(part.part), !side};
  const Vec3& centre = core ? core->centre() : context.pose.position;
  FeatureExclusion result = core ? exclude_feature_by_core(context, *core, feature, bound, enough_m, glance)
                                 : exclude_feature_contacts(context.cache, feature, context.settings.normal_form,
                                                            centre, bound, enough_m, glance);
  if (!side && !(result.margin_m > 0.0))
    result.margin_m = std::max(0.0, behind_corner(context.cache.mesh(), feature.triangle, feature.number, centre));
  return result;
}

/// On a side, where it is nearest to that point, but away from its ends: from there a solve leaves it at once.
SurfacePlace start_on_side(const ContactMesh& mesh, std::uint32_t t, std::uint32_t k, const Vec3& point) {
  constexpr double kFromEnd = 0.125;
  const Vec3 &p = mesh.position(t, k), chord = mesh.position(t, (k + 1) % 3) - p;
  const double along = glm::dot(point - p, chord) / glm::dot(chord, chord);
  return place_on_edge(t, k, std::clamp(along, kFromEnd, 1.0 - kFromEnd));
}

/// Where the finger touches a crease first: of one that is not round that is its support for the normals' middle.
Vec3 place_towards_side(const ContactContext& context, std::uint32_t t, std::uint32_t k) {
  const ContactMesh& mesh = context.cache.mesh();
  const EdgeLink other = mesh.across(t, k);
  if (is_round(context.finger) || other.triangle == kNone) return context.pose.position;
  const std::uint32_t l = other.edge;
  const Vec3 sum = mesh.normal(t, k) + mesh.normal(t, (k + 1) % 3) + mesh.normal(other.triangle, l) +
                   mesh.normal(other.triangle, (l + 1) % 3);
  return glm::dot(sum, sum) > 1e-6 ? context.core->support(unit(sum)).point : context.pose.position;
}

}  // namespace

PatchExclusion exclude_part(ContactContext& context, PartOfTriangle& part, const RankBound& bound, double enough_m) {
  if (part.part == SearchPart::region) return exclude_region(context, part.triangle, bound);
  if (part.part == SearchPart::face)
    return is_round(context.finger) ? exclude_face(context, part.triangle, bound, enough_m)
                                    : exclude_face_by_core(context, *context.core, part.triangle, bound, enough_m);
  const FeatureExclusion feature = exclude_feature(context, context.core, part, bound, enough_m, false);
  PatchExclusion proof;
  proof.margin_m = feature.margin_m;
  proof.by_rank = feature.by_rank;
  proof.tests = feature.tests;
  if (proof.margin_m > 0.0) proof.possible = false;
  return proof;
}

SurfacePlace start_on(const ContactContext& context, const PartOfTriangle& part, const PatchExclusion& proof) {
  const std::uint32_t t = part.triangle;
  if (is_side(part.part)) {
    const std::uint32_t k = side_of(part.part);
    return start_on_side(context.cache.mesh(), t, k, place_towards_side(context, t, k));
  }
  if (is_corner(part.part)) return place_on_vertex(t, corner_of(part.part));
  return place_on_face(t, proof.u, std::min(proof.v, 1.0 - proof.u));
}

bool excludes_at_a_glance(ContactContext& context, const FingerCore* core, const PartOfTriangle& part,
                          const RankBound& bound, double enough_m, int& tests) {
  if (part.part != SearchPart::face) {
    const FeatureExclusion feature = exclude_feature(context, core, part, bound, enough_m, true);
    tests += feature.tests;
    return feature.margin_m >= enough_m;
  }
  const ContactMesh& mesh = context.cache.mesh();
  const NormalForm form = context.settings.normal_form;
  // A closer look tells little more: of a capsule's faces on a random body 1 in 14 of the rest.
  if (core) {
    const double by_corners = corner_exclusion_by_core(context.cache, part.triangle, form, *core, enough_m);
    return by_corners > 0.0 && by_corners >= enough_m;
  }
  const Vec3& centre = context.pose.position;
  return corners_exclude(context.cache, part.triangle, form, centre, enough_m) ||
         even_exclusion(mesh, part.triangle, centre) >= enough_m ||
         margin_by_rank(context.cache.patch(part.triangle, form), centre, bound) >= enough_m;
}

}  // namespace tangent
