#include "core/contact/seed.h"

#include "core/base/tolerances.h"
#include "core/contact/exclusion.h"
#include "core/contact/vertex_fan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

TrackedPlane face_at(std::uint32_t triangle, double u, double v) {
  TrackedPlane place;
  place.feature = Feature::face;
  place.triangle = triangle;
  place.u = u;
  place.v = std::min(v, 1.0 - u);
  return place;
}

/// corner_exclusion for other than round fingers: seen from the support point p(A) of the triangle's mean normal A, the
/// contact p(N) + depth N of a normal N of the patch misses the line along N by no more than p moves between A and N.
double exclude_unround(IterationContext& context, std::uint32_t t) {
  constexpr double kRoom = 1.5;  // from the corner normals to any normal of the patch
  const ContactMesh& mesh = context.cache.mesh();
  const auto n = mesh.normals(t);
  const Vec3 sum = n[0] + n[1] + n[2];
  if (glm::dot(sum, sum) < 4.0) return 0.0;
  const Vec3 support = support_point(context.finger, context.pose, unit(sum));
  double moves = 0.0;
  for (const Vec3& normal : n) moves = std::max(moves, glm::distance(support, support_point(context.finger, context.pose, normal)));
  return std::max(0.0, corner_exclusion(mesh, t, support) - kRoom * moves);
}

/// Proof that triangle t holds no contact of a rank under `bound`, its crease and boundary edges included. Its margin
/// is how far the centre may go until the triangle could hold one.
PatchExclusion excluded(IterationContext& context, std::uint32_t t, double bound) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3& centre = context.pose.position;
  const NormalForm form = context.settings.normal_form;
  const auto unknown = [&] {
    const NearestHit hit = closest_on_triangle(mesh, t, centre);
    return PatchExclusion{0.0, 0.0, true, hit.u, hit.v, 0.0};
  };
  PatchExclusion proof;
  if (!is_round(context.finger)) {
    if (!mesh.interior(t)) return unknown();
    proof.margin_m = exclude_unround(context, t);
    proof.possible = false;
    return proof.margin_m > 0.0 ? proof : unknown();
  }
  proof.margin_m = corner_exclusion(mesh, t, centre);
  if (proof.margin_m > 0.0) {
    proof.possible = false;
  } else {
    proof = exclude_contact(context.cache.patch(t, form), centre);
    proof.margin_m = std::max(proof.margin_m, 0.5 * (proof.least_height_m - bound));
    if (proof.margin_m > 0.0) proof.possible = false;
  }
  if (mesh.interior(t)) return proof;
  const double features = exclude_feature_contacts(context.cache, t, form, centre, bound);
  if (features <= 0.0) return unknown();
  proof.margin_m = std::min(proof.margin_m, features);
  return proof;
}

/// A capsule's side is all but straight: its Newton steps turn the normal only so far at a time.
int seed_budget(const Finger& finger) { return is_round(finger) ? kSeedBudget : 4 * kSeedBudget; }

/// Keeps the best of many seeds: converged before unstable before unconverged, then the least rank or error.
struct Selection {
  SeedResult result;
  int group = 3;
  double value = std::numeric_limits<double>::infinity();

  bool offer(const IterationContext& context, const IterationResult& r) {
    result.evaluations += r.evaluations;
    const bool exact = r.contact.error_m < context.settings.tolerance_m;
    const int here = r.converged() ? 0 : r.stop == StopReason::unstable && exact ? 1 : 2;
    const double rank = here == 2 ? r.contact.error_m : contact_rank(context.finger, r.contact);
    if (here < group || (here == group && rank < value)) {
      group = here;
      value = rank;
      result.best = r;
    }
    result.found = group == 0;
    return r.converged();
  }
};

/// Bounds of a query that shall only see contacts of a rank below `rank`.
void limit_query(ContactQuery& query, const Finger& finger, double rank) {
  query.nearest_m = rank + finger.unroundness_m();
  query.inside_m = rank - finger.reach_m() + finger.unroundness_m();
}

void seed_by_hierarchy(IterationContext& context, const ContactScene& scene, Selection& selection) {
  ContactQuery query;
  query.centre = context.pose.position;
  query.nearest_m = query.inside_m = std::numeric_limits<double>::max();
  query.tilt_rad = context.finger.tilt_rad();
  int solves = 0;
  scene.hierarchy().visit(query, [&](std::uint32_t t, ContactQuery& q) {
    const PatchExclusion proof = excluded(context, t, selection.group == 0 ? selection.value : std::numeric_limits<double>::max());
    if (proof.margin_m > 0.0) return true;
    context.seed = static_cast<std::uint8_t>(std::min(++solves, 255));
    IterationResult r;
    iterate(context, face_at(t, proof.u, proof.v), seed_budget(context.finger), r);
    selection.offer(context, r);
    if (selection.group == 0) limit_query(q, context.finger, selection.value);
    return solves < kMaxSolves;
  });
}

/// Whether a contact lies so much further off than the raw mesh that a nearer one must have been missed. Asks only for
/// triangles nearer than that, of which there are none as a rule, so the query ends early.
bool implausible(IterationContext& context, const ContactScene& scene, const IterationResult& found, double rank) {
  if (!is_round(context.finger)) return false;
  const double bulge = patch_bulge(context.cache.patch(found.plane.triangle, context.settings.normal_form));
  const double nearer = rank / (1.0 + kImplausibleShare) - 2.0 * bulge;
  return nearer > 0.0 && scene.nearest().nearest(context.pose.position, nearer);
}

/// What is known of the distance to the nearest triangle before asking.
double known_radius(const IterationContext& context, const TrackedPlane& kept) {
  if (kept.feature == Feature::none) return std::numeric_limits<double>::infinity();
  return closest_on_triangle(context.cache.mesh(), kept.triangle, context.pose.position).distance_m;
}

void seed_by_distance(IterationContext& context, const ContactScene& scene, std::size_t seeds, double radius, int budget, bool twice,
                      Selection& selection) {
  std::array<NearestHit, kSeeds> hits;
  const std::size_t count = scene.nearest().nearest_several(context.pose.position, radius, std::span(hits).first(seeds));
  for (std::size_t i = 0; i < count; ++i) {
    context.seed = static_cast<std::uint8_t>(i + 1);
    IterationResult r;
    iterate(context, face_at(hits[i].triangle, hits[i].u, hits[i].v), budget, r);
    if (selection.offer(context, r) || !twice) continue;
    // A folded patch can hide its contact from its closest point; its middle is a second chance.
    iterate(context, face_at(hits[i].triangle, 1.0 / 3.0, 1.0 / 3.0), budget, r);
    selection.offer(context, r);
  }
}

/// Last resort, where no seed finds a contact of the interpolated normals, or none near the raw mesh: the place near the raw mesh's closest points
/// whose plane, turned to face the finger, is touched deepest. Its error is nought, its normal is the finger's.
void face_the_finger(IterationContext& context, const ContactScene& scene, Selection& selection) {
  std::array<NearestHit, kSeeds> hits;
  const std::size_t count =
      scene.nearest().nearest_several(context.pose.position, std::numeric_limits<double>::infinity(), std::span(hits));
  for (std::size_t i = 0; i < count; ++i) {
    IterationResult r;
    r.plane = face_at(hits[i].triangle, hits[i].u, hits[i].v);
    r.sample = sample_place(context, r.plane);
    r.evaluations = 1;
    const Vec3 interpolated = r.plane.normal;
    r.plane.normal = facing_normal(context, r.plane.point, interpolated);
    if (is_round(context.finger) && glm::dot(r.plane.normal, interpolated) < 0.0) r.plane.normal = -r.plane.normal;
    r.contact = contact_on_plane(context.finger, context.pose, r.plane.point, r.plane.normal);
    r.stop = r.contact.error_m < context.settings.tolerance_m ? StopReason::converged : StopReason::iteration_limit;
    selection.offer(context, r);
  }
  if (!context.trace || !selection.result.found) return;
  const IterationResult& best = selection.result.best;
  IterationRecord record;
  record.feature = best.plane.feature;
  record.stop = best.stop;
  record.seed = 255;
  record.triangle = best.plane.triangle;
  record.u = best.plane.u;
  record.v = best.plane.v;
  record.point = record.contact = context.origin + best.plane.point;
  record.normal = best.plane.normal;
  record.travel = best.contact.travel;
  record.error_m = best.contact.error_m;
  record.distance_m = best.contact.penetration_m;
  context.trace->push(record);
}

/// A contact whose surroundings need no search.
struct KnownContact {
  Feature feature;
  std::uint8_t side;
  std::uint32_t triangle;
  Vec3 point, normal;
  double height_m;
  double size;  ///< longest side of its triangle
};

double longest_side(const ContactMesh& mesh, std::uint32_t t) {
  const auto p = mesh.positions(t);
  const auto square = [](const Vec3& v) { return glm::dot(v, v); };
  return std::sqrt(std::max({square(p[1] - p[0]), square(p[2] - p[1]), square(p[0] - p[2])}));
}

/// Whether triangle t has the edge or vertex that the known contact rests on.
bool shares_feature(const ContactMesh& mesh, std::uint32_t t, const KnownContact& known) {
  if (known.feature == Feature::edge) return mesh.across(known.triangle, known.side).triangle == t;
  const std::uint32_t vertex = mesh.vertex(known.triangle, known.side);
  return mesh.vertex(t, 0) == vertex || mesh.vertex(t, 1) == vertex || mesh.vertex(t, 2) == vertex;
}

/// Whether triangle t surely belongs to the slope that leads to a known contact: towards each of its corners the
/// normal turns no faster than a contact at height h stays stable with (1 + h k > 0, with room), and the corner does
/// not rise from it towards the finger. Only near it, as far as the look-ahead `margin` calls for: further off there
/// may be a fold between.
bool same_basin(const ContactMesh& mesh, std::uint32_t t, const KnownContact& known, double margin) {
  if (t == known.triangle) return true;
  if (known.feature != Feature::face && shares_feature(mesh, t, known)) return true;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 dp = mesh.position(t, k) - known.point;
    const Vec3 dn = mesh.normal(t, k) - known.normal;
    const double distance2 = glm::dot(dp, dp), over = glm::dot(dp, known.normal);
    const double agreement = glm::dot(mesh.normal(t, k), known.normal);
    const double reach = known.size + (agreement > kGentleCosine ? kGentleReach : kBasinReach) * margin;
    if (distance2 > reach * reach || agreement < kBasinCosine) return false;
    if (over * known.height_m > 0.0 && over * over > 0.25 * distance2) return false;
    if (known.height_m * glm::dot(dn, dp) < -0.5 * distance2) return false;
  }
  return true;
}

Vec3 interpolated_normal(const ContactMesh& mesh, std::uint32_t t, double u, double v) {
  const auto n = mesh.normals(t);
  return (1.0 - u - v) * n[0] + u * n[1] + v * n[2];
}

/// How far the centre may go before a rival that ranks `gap` behind can overtake: heights change along their normals,
/// and in second order by the square of the way over the height.
double overtaking_margin(const KnownContact& tracked, const Vec3& rival_normal, double rival_height, double gap) {
  const Vec3 apart = tracked.normal - rival_normal;
  const double rate = std::sqrt(glm::dot(apart, apart)) + 1e-3;
  const double bend = 2.0 / std::max(1e-12, std::min(std::abs(tracked.height_m), std::abs(rival_height)));
  // Smaller root of rate m + bend m^2 = gap.
  return 2.0 * gap / (rate + std::sqrt(rate * rate + 4.0 * bend * gap));
}

}  // namespace

double contact_rank(const Finger& finger, const PlaneContact& contact) {
  return contact.height_m >= 0.0 ? finger.reach_m() - contact.penetration_m : contact.penetration_m;
}

SeedResult seed_contact(IterationContext& context, const ContactScene& scene, const TrackedPlane& kept) {
  Selection selection;
  if (context.settings.method != Method::robust) {
    seed_by_distance(context, scene, 1, known_radius(context, kept), context.settings.max_iterations, false, selection);
  } else {
    seed_by_hierarchy(context, scene, selection);
    if (selection.group != 0 || implausible(context, scene, selection.result.best, selection.value))
      seed_by_distance(context, scene, kSeeds, std::numeric_limits<double>::infinity(), seed_budget(context.finger), true, selection);
    if (selection.group == 2 || (selection.group == 0 && implausible(context, scene, selection.result.best, selection.value)))
      face_the_finger(context, scene, selection);
  }
  context.seed = 0;
  if (context.settings.method == Method::robust && selection.group == 1) {
    // Every contact there is unstable: the finger touches all round (at a sphere's centre, say). Show the nearest.
    selection.result.found = true;
    selection.result.best.stop = StopReason::converged;
  }
  return selection.result;
}

RivalResult find_rival(IterationContext& context, const ContactScene& scene, const IterationResult& tracked,
                       double bound_m, double margin_m) {
  SolverSettings settings = context.settings;
  settings.method = Method::robust;
  IterationContext search{context.cache, settings, context.finger, context.pose, context.origin, context.trace, 0};

  RivalResult result;
  result.clearance = {context.pose.position, margin_m, bound_m + 2.0 * margin_m};
  double deepest = bound_m;
  std::array<KnownContact, kKnownContacts> known;
  std::size_t known_count = 0;
  const auto remember = [&](const IterationResult& r) {
    if (known_count < known.size()) known[known_count++] = {r.plane.feature, r.plane.side, r.plane.triangle, r.plane.point, r.plane.normal, r.contact.height_m,
                              longest_side(context.cache.mesh(), r.plane.triangle)};
  };
  remember(tracked);
  const auto shrink = [&](ContactQuery& q, double margin) {
    if (margin >= result.clearance.margin_m) return;
    result.clearance.margin_m = q.margin_m = margin;
    limit_query(q, context.finger, bound_m + 2.0 * margin);
  };
  int solves = 0;
  ContactQuery query;
  query.centre = context.pose.position;
  query.margin_m = margin_m;
  query.tilt_rad = context.finger.tilt_rad();
  limit_query(query, context.finger, bound_m + 2.0 * margin_m);
  scene.hierarchy().visit(query, [&](std::uint32_t t, ContactQuery& q) {
    const ContactMesh& mesh = context.cache.mesh();
    for (std::size_t i = 0; i < known_count; ++i)
      if (same_basin(mesh, t, known[i], q.margin_m)) return true;
    const PatchExclusion proof = excluded(context, t, bound_m);
    if (proof.margin_m > 0.0 && !proof.possible) {
      shrink(q, proof.margin_m);
      return true;
    }
    if (!proof.possible) {
      shrink(q, kUnresolvedMargin * margin_m);
      return true;
    }
    const double guess = proof.height_m >= 0.0 ? proof.height_m : context.finger.reach_m() - proof.height_m;
    const double behind = guess - bound_m;
    if (proof.height_m != 0.0 && behind > kHeightGuess * guess) {
      // A rival, but not a deeper one yet.
      shrink(q, overtaking_margin(known[0], interpolated_normal(mesh, t, proof.u, proof.v),
                                  proof.height_m, behind));
      return true;
    }
    search.seed = static_cast<std::uint8_t>(std::min(++solves, 255));
    IterationResult r;
    iterate(search, face_at(t, proof.u, proof.v), mesh.interior(t) ? kRivalBudget : 2 * kRivalBudget, r);
    result.evaluations += r.evaluations;
    if (!r.converged()) {
      // No contact there now, but one may come up: ask again before long.
      shrink(q, kUnresolvedMargin * margin_m);
      return solves < kMaxSolves;
    }
    const Vec3 apart = r.plane.point - tracked.plane.point;
    const double same = 10.0 * settings.tolerance_m;
    if (glm::dot(apart, apart) <= same * same) return true;
    remember(r);
    const double rank = contact_rank(context.finger, r.contact);
    if (rank < deepest) {
      deepest = rank;
      result.best = r;
      result.deeper = true;
    }
    shrink(q, overtaking_margin(known[0], r.plane.normal, r.contact.height_m, std::max(0.0, rank - bound_m)));
    return solves < kMaxSolves;
  });
  result.clearance.height_m = bound_m + 2.0 * result.clearance.margin_m;
  if (solves >= kMaxSolves) result.clearance.margin_m = 0.0;
  return result;
}

}  // namespace tangent
