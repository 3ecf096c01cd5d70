#include "core/contact/prove/triangle_proof.h"

#include "core/contact/contact_rank.h"
#include "core/contact/nearest_triangles.h"
#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/core_feature_proof.h"
#include "core/contact/prove/core_proof.h"
#include "core/finger/plane_contact.h"

#include <algorithm>
#include <limits>

namespace tangent {
namespace {

/// Nothing proved; a solve had best start at the triangle's closest point.
PatchExclusion unknown(const ContactContext& context, std::uint32_t t) {
  const NearestHit hit = closest_on_triangle(context.cache.mesh(), t, context.pose.position);
  PatchExclusion nothing;
  nothing.u = hit.u;
  nothing.v = hit.v;
  return nothing;
}

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

PatchExclusion exclude_face(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m) {
  const Vec3& centre = context.pose.position;
  PatchExclusion proof;
  const double at_once =
      std::max(corner_exclusion(context.cache.mesh(), t, centre), even_exclusion(context.cache.mesh(), t, centre));
  if (at_once > 0.0 && at_once >= enough_m) {
    proof.margin_m = at_once;
    proof.possible = false;
    return proof;
  }
  proof = exclude_contact(context.cache.patch(t, context.settings.normal_form), centre, enough_m, bound);
  proof.margin_m = std::max({at_once, proof.margin_m, bound.way_to(proof.least_height_m)});
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
  if (proof.margin_m > 0.0) proof.possible = false;
  return proof;
}

PatchExclusion exclude_side(ContactContext& context, const PartOfTriangle& part, const RankBound& bound,
                            double enough_m, FeatureMemory* memory) {
  PatchExclusion proof;
  const TriangleFeatures side{part.triangle, side_of(part.part)};
  proof.margin_m = is_round(context.finger)
                       ? exclude_feature_contacts(context.cache, side, context.settings.normal_form,
                                                  context.pose.position, bound, enough_m, memory)
                       : exclude_features_by_core(context, *context.core, side, bound, enough_m).margin_m;
  if (proof.margin_m > 0.0) proof.possible = false;
  return proof;
}

/// Whether the corners of a face tell as much.
bool corners_exclude(const ContactMesh& mesh, std::uint32_t t, const Vec3& centre, double enough_m) {
  return corner_exclusion(mesh, t, centre) >= enough_m || even_exclusion(mesh, t, centre) >= enough_m;
}

}  // namespace

PatchExclusion exclude_part(ContactContext& context, PartOfTriangle& part, const RankBound& bound, double enough_m,
                            FeatureMemory* memory, bool face) {
  if (part.part == SearchPart::whole) return exclude_triangle(context, part.triangle, bound, enough_m, memory, face);
  if (part.part == SearchPart::region) return exclude_region(context, part.triangle, bound);
  if (is_side(part.part)) return exclude_side(context, part, bound, enough_m, memory);
  return is_round(context.finger) ? exclude_face(context, part.triangle, bound, enough_m)
                                  : exclude_face_by_core(context, *context.core, part.triangle, bound, enough_m);
}

/// On a side, where it is nearest to the finger's centre.
static SurfacePlace start_on_side(const ContactContext& context, std::uint32_t t, std::uint32_t k) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3 &p = mesh.position(t, k), chord = mesh.position(t, (k + 1) % 3) - p;
  const double along = glm::dot(context.pose.position - p, chord) / glm::dot(chord, chord);
  return place_on_edge(t, k, std::clamp(along, 0.0, 1.0));
}

SurfacePlace start_on(const ContactContext& context, const PartOfTriangle& part, const PatchExclusion& proof) {
  if (is_side(part.part)) return start_on_side(context, part.triangle, side_of(part.part));
  const std::optional<std::uint32_t> boundary = boundary_with_key(context.cache.mesh(), part.triangle, proof.feature);
  if (boundary) return start_on_side(context, part.triangle, *boundary);
  return place_on_face(part.triangle, proof.u, std::min(proof.v, 1.0 - proof.u));
}

GlanceExcludes glance_at(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m,
                         FeatureMemory* memory) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3& centre = context.pose.position;
  const NormalForm form = context.settings.normal_form;
  if (!corners_exclude(mesh, t, centre, enough_m) &&
      !excludes_at_a_glance(context.cache.patch(t, form), centre, bound, enough_m))
    return GlanceExcludes::nothing;
  if (mesh.interior(t)) return GlanceExcludes::all;
  const double features = exclude_feature_contacts(context.cache, {t}, form, centre, bound, enough_m, memory, true);
  return features >= enough_m ? GlanceExcludes::all : GlanceExcludes::face;
}

PatchExclusion exclude_triangle(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m,
                                FeatureMemory* memory, bool face) {
  const ContactMesh& mesh = context.cache.mesh();
  if (!is_round(context.finger)) return exclude_by_core(context, *context.core, t, bound, enough_m, memory);
  PatchExclusion proof;
  proof.margin_m = std::numeric_limits<double>::max();
  proof.possible = false;
  if (face) proof = exclude_face(context, t, bound, enough_m);
  if (mesh.interior(t)) return proof;
  const double features = exclude_feature_contacts(context.cache, {t}, context.settings.normal_form,
                                                   context.pose.position, bound, enough_m, memory);
  if (features <= 0.0) {
    PatchExclusion nothing = unknown(context, t);
    nothing.also_inside = proof.possible && proof.height_m != 0.0;
    nothing.inside_u = proof.u;
    nothing.inside_v = proof.v;
    return nothing;
  }
  proof.margin_m = std::min(proof.margin_m, features);
  return proof;
}

}  // namespace tangent
