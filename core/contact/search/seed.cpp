#include "core/contact/search/seed.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"
#include "core/contact/follow/follow.h"
#include "core/contact/follow/hollow.h"
#include "core/contact/prove/clearance_check.h"
#include "core/contact/prove/triangle_proof.h"
#include "core/contact/search/beyond_fold.h"
#include "core/contact/search/seed_selection.h"
#include "core/contact/search_work.h"
#include "core/finger/facing_normal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tangent {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::max();
constexpr int kAllWork = std::numeric_limits<int>::max();
constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

SurfacePlace face_at(std::uint32_t triangle, double u, double v) {
  return place_on_face(triangle, u, std::min(v, 1.0 - u));
}

/// A capsule's side is all but straight: its Newton steps turn the normal only so far at a time.
int seed_budget(const Finger& finger) { return is_round(finger) ? kSeedBudget : 4 * kSeedBudget; }

/// What is known of the distance to the nearest triangle before asking.
double known_radius(const ContactContext& context, const TrackedPlane& kept) {
  if (kept.feature == Feature::none) return std::numeric_limits<double>::infinity();
  return closest_on_triangle(context.cache.mesh(), kept.triangle, context.pose.position).distance_m;
}

/// A rank that the deepest contact can hardly exceed: that of the raw mesh's nearest triangle, with room for its bulge.
/// What a search finds below it is what one without it would have found; where it finds nothing it was in vain. Of a
/// finger that is not round and whose centre is outside what it may soon touch: where that is nothing, any place does.
double likely_rank(ContactContext& context, const SearchStructures& search, double radius) {
  const Vec3& centre = context.pose.position;
  const NearestHit hit = search.nearest.nearest(centre, radius);
  if (!hit) return kUnlimited;
  const auto n = context.cache.mesh().normals(hit.triangle);
  const Vec3 normal = (1.0 - hit.u - hit.v) * n[0] + hit.u * n[1] + hit.v * n[2];
  const bool outside = glm::dot(centre - hit.point, normal) >= 0.0;
  if (!is_round(context.finger)) return outside ? context.soon_touched_rank() : kUnlimited;
  const double bulge = patch_bulge(context.cache.patch(hit.triangle, context.settings.normal_form));
  const double further = (1.0 + kImplausibleShare) * hit.distance_m + 2.0 * bulge;
  return outside ? further : context.finger.reach_m() + further;
}

/// Every contact of a finger at the context's pose, however far off. `core`: room for that of one that is not round.
ContactQuery query_for_all(ContactContext& context, std::optional<FingerCore>& core) {
  ContactQuery query;
  query.centre = context.pose.position;
  query.nearest_m = query.inside_m = std::numeric_limits<double>::max();
  query.tilt_rad = context.finger.tilt_rad();
  if (!is_round(context.finger)) query.core = context.core = &core.emplace(context.finger, context.pose);
  return query;
}

SearchWork work_of(const Finger& finger) { return is_round(finger) ? SearchWork::of_round() : SearchWork::of_core(); }

/// The last record of a trace is the place that is shown: of one that no solve came to.
void record(const ContactContext& context, const IterationResult& best) {
  if (!context.trace) return;
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

/// A search of everything that is begun now.
Clearance begun_at(const FingerPose& pose) {
  Clearance begun;
  begun.centre = pose.position;
  begun.orientation = pose.orientation;
  return begun;
}

/// Whether a search for seeds is under way that a finger here can go on with.
bool is_under_way(const ContactContext& context, const Clearance& begun) {
  const bool of_rivals = begun.margin_m >= 0.0;  // one of a tick before that searched for other things
  return begun.under_way && !of_rivals &&
         gone_m(begun, context.finger, context.pose) <= context.hystereses_m(kMostLateStart);
}

/// A part of one search of everything, from the pose that it began at. What it finds there is led to the present pose.
/// False: it goes on at the next tick.
bool seed_in_parts(ContactContext& context, const SearchStructures& search, int work, Clearance& begun,
                   SeedSelection& selection) {
  if (!is_under_way(context, begun)) begun = begun_at(context.pose);
  const FingerPose pose{begun.centre, begun.orientation};
  ContactContext there{context.cache, context.settings, context.finger, pose, context.origin};
  std::optional<FingerCore> core;
  ContactQuery query = query_for_all(there, core);
  query.most_work = work;
  const SearchWork cost = work_of(context.finger);
  double rank = std::numeric_limits<double>::max();
  const auto visit = [&](std::uint32_t t, ContactQuery& q) {
    PartOfTriangle part{t, q.part};
    const PatchExclusion proof = exclude_part(there, part, {rank});
    q.work += cost.look + cost.test * proof.tests;
    if (proof.margin_m > 0.0) return true;
    IterationResult then, now;
    iterate(there, start_on(there, part, proof), kSeedBudget, then);
    q.work += cost.evaluation * then.evaluations;
    selection.result.evaluations += then.evaluations;
    if (!then.converged() || !(contact_rank(context.finger, then.contact) < rank)) return true;
    lead(context, then.plane, now);
    const bool counts = selection.offer(context, now) && selection.group_of(context, now) == SeedGroup::entered;
    if (!counts) return true;
    rank = contact_rank(context.finger, then.contact);
    limit_query(q, context.finger, rank);
    return true;
  };
  begun.under_way = !search.hierarchy.visit_from(begun.next, query, visit);
  return !begun.under_way;
}

/// A capsule's side takes more steps, where what comes of it may count.
void solve_start(ContactContext& context, const SurfacePlace& start, double most, IterationResult& r) {
  iterate(context, start, kSeedBudget, r);
  const int more = seed_budget(context.finger) - r.evaluations;
  const bool ran_out = !r.converged() && r.stop != StopReason::unstable && r.evaluations >= kSeedBudget;
  if (!ran_out || more <= 0 || !(contact_rank(context.finger, r.contact) < most)) return;
  const int evaluations = r.evaluations;
  const TrackedPlane so_far = r.plane;
  iterate(context, so_far, more, r);
  r.evaluations += evaluations;
}

/// Where a finger that is not round has an unstable contact that would count, stable ones beside it may, too.
bool offer_beyond_fold(ContactContext& context, const IterationResult& unstable, double most, ContactQuery& q,
                       SeedSelection& selection) {
  constexpr double kNear = 0.05;  // of the finger's reach: a solve that ended further off tells of none there
  if (unstable.stop != StopReason::unstable || is_round(context.finger) ||
      !(unstable.contact.error_m < kNear * context.finger.reach_m()) ||
      !(contact_rank(context.finger, unstable.contact) < selection.bound_m(most)))
    return false;
  bool found = false;
  for (const double sign : {-1.0, 1.0}) {
    IterationResult r;
    iterate_beyond_fold(context, unstable, sign, kSeedBudget, r);
    q.work += SearchWork::of_core().evaluation * r.evaluations;
    found = (r.evaluations > 0 && selection.offer(context, r)) || found;
  }
  return found;
}

/// Along a sharp edge, or out over a rim, the steps of a finger that is not round may go to and fro beside an end of
/// it, where the contact is.
bool offer_ends(ContactContext& context, const IterationResult& stuck, double most, ContactQuery& q,
                SeedSelection& selection) {
  const bool lost = stuck.stop == StopReason::cycling || stuck.stop == StopReason::left_boundary;
  if (!lost || stuck.plane.feature != Feature::edge || is_round(context.finger) ||
      !(contact_rank(context.finger, stuck.contact) < selection.bound_m(most)))
    return false;
  bool found = false;
  for (const std::uint32_t corner : {std::uint32_t{stuck.plane.side}, (stuck.plane.side + 1u) % 3u}) {
    const Vec2 uv = corner_uv(corner);
    IterationResult r;
    iterate(context, {Feature::vertex, static_cast<std::uint8_t>(corner), stuck.plane.triangle, uv.x, uv.y},
            kSeedBudget, r);
    q.work += SearchWork::of_core().evaluation * r.evaluations;
    found = selection.offer(context, r) || found;
  }
  return found;
}

/// Contacts of a rank below `most`. What failed before is not tried again: it would start from the same place. False:
/// the work was used up before the end, and `from` is where to go on.
bool seed_by_hierarchy(ContactContext& context, const SearchStructures& search, double most, int work, VisitPlace& from,
                       FailedStarts& failed, SeedSelection& selection) {
  std::optional<FingerCore> core;
  ContactQuery query = query_for_all(context, core);
  if (most < std::numeric_limits<double>::max()) limit_query(query, context.finger, most);
  query.most_work = work;
  const SearchWork cost = work_of(context.finger);
  int solves = 0;
  const auto visit = [&](std::uint32_t t, ContactQuery& q) {
    if (failed.has(t, q.part)) return true;
    PartOfTriangle part{t, q.part};
    const PatchExclusion proof = exclude_part(context, part, {selection.bound_m(most)});
    q.work += cost.look + cost.test * proof.tests;
    if (proof.margin_m > 0.0) return true;
    context.seed = static_cast<std::uint8_t>(std::min(++solves, 255));
    IterationResult r;
    solve_start(context, start_on(context, part, proof), selection.bound_m(most), r);
    q.work += cost.evaluation * r.evaluations;
    const bool found = selection.offer(context, r) || offer_beyond_fold(context, r, most, q, selection) ||
                       offer_ends(context, r, most, q, selection);
    if (!found) {
      failed.add(t, q.part);
      if (part.triangle != t) failed.add(part.triangle, q.part);
    }
    if (selection.bounds_search()) limit_query(q, context.finger, std::min(most, selection.value));
    // One that is touched from before is known: solves that walk far off their triangle tell no more of it.
    if (q.core && selection.bounds_search() && selection.value < context.finger.reach_m())
      context.most_crossings = kMostRivalCrossings;
    return solves < kMaxSolves;
  };
  const bool through = search.hierarchy.visit_from(from, query, visit);
  if (!through || solves >= kMaxSolves) failed.break_off();
  context.core = nullptr;
  context.most_crossings = kMostCrossings;
  return through;
}

/// Whether a contact lies so much further off than the raw mesh that a nearer one must have been missed. Asks only for
/// triangles nearer than that, of which there are none as a rule, so the query ends early.
bool implausible(ContactContext& context, const SearchStructures& search, const IterationResult& found, double rank) {
  if (!is_round(context.finger)) return false;
  if (found.contact.height_m < 0.0 && is_hollow(context.cache.mesh(), found.plane)) return false;  // seen from inside
  const double bulge = patch_bulge(context.cache.patch(found.plane.triangle, context.settings.normal_form));
  const double nearer = rank / (1.0 + kImplausibleShare) - 2.0 * bulge;
  return nearer > 0.0 && search.nearest.nearest(context.pose.position, nearer);
}

/// `failed`: of the search of everything before it; null: there was none, and the closest point is all that is tried.
/// `in_motion`: where that search found a contact, only what it left open is tried, once and briefly.
void seed_by_distance(ContactContext& context, const SearchStructures& search, std::size_t seeds, double radius,
                      int budget, const FailedStarts* failed, bool in_motion, SeedSelection& selection) {
  std::array<NearestHit, kSeeds> hits;
  const std::size_t count = search.nearest.nearest_several(context.pose.position, radius, std::span(hits).first(seeds));
  for (std::size_t i = 0; i < count; ++i) {
    const bool known = in_motion && selection.found();
    if (known && !failed->may_hold(hits[i].triangle)) continue;
    context.seed = static_cast<std::uint8_t>(i + 1);
    IterationResult r;
    iterate(context, face_at(hits[i].triangle, hits[i].u, hits[i].v), known ? budget / 2 : budget, r);
    if (selection.offer(context, r) || !failed || known) continue;
    // A folded patch can hide its contact from its closest point; its middle is a second chance.
    iterate(context, face_at(hits[i].triangle, 1.0 / 3.0, 1.0 / 3.0), budget, r);
    selection.offer(context, r);
  }
}

/// A place that a finger touches nothing at, near where the raw mesh is nearest. True where there is one.
bool seed_free(ContactContext& context, const SearchStructures& search, double radius, SeedSelection& selection) {
  std::array<NearestHit, kSeeds / 4> hits;
  const std::size_t count = search.nearest.nearest_several(context.pose.position, radius, std::span(hits));
  for (std::size_t i = 0; i < count; ++i) {
    context.seed = static_cast<std::uint8_t>(i + 1);
    IterationResult r;
    iterate(context, face_at(hits[i].triangle, hits[i].u, hits[i].v), seed_budget(context.finger), r);
    if (r.converged() && is_free(context.finger, r.contact)) return selection.offer(context, r);
    selection.result.evaluations += r.evaluations;
  }
  return false;
}

/// Where the raw mesh's nearest point is on a hollow crease or corner, the contact that a finger pressed into it has
/// there. Nearest to the centre, of a finger that is not round to what it presses against the nearest place with.
void seed_in_hollow(ContactContext& context, const SearchStructures& search, double radius, SeedSelection& selection) {
  const ContactMesh& mesh = context.cache.mesh();
  if (!mesh.has_concave_crease()) return;
  NearestHit hit = search.nearest.nearest(context.pose.position, radius);
  if (!hit) return;
  if (!is_round(context.finger)) {
    const auto n = mesh.normals(hit.triangle);
    const Vec3 normal = unit((1.0 - hit.u - hit.v) * n[0] + hit.u * n[1] + hit.v * n[2]);
    hit = search.nearest.nearest(support_point(context.finger, context.pose, normal), kAnyDistance);
  }
  IterationResult r;
  if (!find_in_hollow(context, feature_at(mesh, hit.triangle, hit.u, hit.v), r)) return;
  selection.offer(context, r);
  if (selection.result.best.plane.point == r.plane.point) record(context, r);
}

/// Where only unstable contacts were found: the stable ones beside the nearest of them.
void leave_unstable(ContactContext& context, SeedSelection& selection) {
  const IterationResult unstable = selection.result.best;
  for (const double sign : {-1.0, 1.0}) {
    IterationResult r;
    iterate_beyond_fold(context, unstable, sign, seed_budget(context.finger), r);
    if (r.evaluations > 0) selection.offer(context, r);
  }
}

/// Last resort, where no seed finds a contact of the interpolated normals, or none near the raw mesh: the place near
/// the raw mesh's closest points whose plane, turned to face the finger, is touched deepest. Its
/// normal is the finger's, its error that of the surface's own normal there.
void face_the_finger(ContactContext& context, const SearchStructures& search, SeedSelection& selection) {
  std::array<NearestHit, kSeeds> hits;
  const std::size_t count =
      search.nearest.nearest_several(context.pose.position, std::numeric_limits<double>::infinity(), std::span(hits));
  for (std::size_t i = 0; i < count; ++i) {
    IterationResult r;
    r.plane.move_to(face_at(hits[i].triangle, hits[i].u, hits[i].v));
    sample_place(context, r.plane, r.sample);
    r.evaluations = 1;
    const Vec3 interpolated = r.plane.normal;
    const PlaneContact own = contact_on_plane(context.finger, context.pose, r.plane.point, interpolated);
    const bool inside = glm::dot(context.pose.position - r.plane.point, interpolated) < 0.0;
    r.plane.normal = facing_normal(context.finger, context.pose, r.plane.point, interpolated,
                                   inside ? FacingSide::back : FacingSide::front);
    r.contact = contact_on_plane(context.finger, context.pose, r.plane.point, r.plane.normal);
    r.stop = r.contact.error_m < context.settings.tolerance_m ? StopReason::facing : StopReason::iteration_limit;
    r.contact.travel = own.travel;
    r.contact.error_m = own.error_m;
    selection.offer(context, r);
  }
  if (selection.result.found) record(context, selection.result.best);
}

/// How much a search for a start does in one tick (search_work.h): up to the likely rank, and of everything.
struct StartWork {
  bool in_motion = false;  ///< neither a first tick nor one after a leap
  int likely = kAllWork, everything = kAllWork;
};

StartWork start_work(const ContactContext& context, const TrackedPlane& kept, bool in_vain, bool in_parts) {
  constexpr int kLost = 4, kLostOfCore = 14;  // ticks' work, in the one in which the contact was lost
  const bool in_motion = kept.feature != Feature::none && context.moved_m <= context.hystereses_m(kLeapOfFinger);
  StartWork work{in_motion};
  if (!in_motion && context.in_real_time) return {false, kStartWork * kTickWork, kStartWorkOfAll * kTickWork};
  if (!in_motion || !in_parts) return work;
  work.likely = (is_round(context.finger) ? kLost : kLostOfCore) * kTickWork;
  work.everything =
      in_vain ? tick_work(kLateStartWork, context.late_m / context.hystereses_m(kMostLateStart)) : kLost * kTickWork;
  return work;
}

void seed_robustly(ContactContext& context, const SearchStructures& search, const TrackedPlane& kept, bool in_vain,
                   Clearance* parts, SeedSelection& selection) {
  const double radius = known_radius(context, kept);
  const double most = in_vain ? kUnlimited : likely_rank(context, search, radius);
  const StartWork work = start_work(context, kept, in_vain, parts != nullptr);
  bool& searching = selection.result.searching;
  FailedStarts failed;
  VisitPlace from;
  if (!in_vain) searching = !seed_by_hierarchy(context, search, most, work.likely, from, failed, selection);
  bool enough = searching || (selection.bounds_search() && selection.value < most);
  if (!enough && most < kUnlimited && !is_round(context.finger)) enough = seed_free(context, search, radius, selection);
  if (!enough && parts && work.in_motion) {
    searching = !seed_in_parts(context, search, work.everything, *parts, selection);
    if (searching) failed.break_off();
  } else if (!enough && (in_vain || most < kUnlimited)) {
    from = {};
    searching = !seed_by_hierarchy(context, search, kUnlimited, work.everything, from, failed, selection);
  }
  if (parts && searching && !work.in_motion) {
    *parts = begun_at(context.pose);
    parts->under_way = 1;
    if (selection.bounds_search() || !(most < kUnlimited)) parts->next = from;  // else that was not everything
  }
  seed_in_hollow(context, search, radius, selection);
  if (!selection.found() || implausible(context, search, selection.result.best, selection.value))
    seed_by_distance(context, search, (in_vain && work.in_motion) || searching ? kSeeds / 4 : kSeeds,
                     std::numeric_limits<double>::infinity(),
                     work.in_motion ? kSeedBudget : seed_budget(context.finger), &failed, work.in_motion, selection);
  if (selection.group == SeedGroup::unstable && !is_round(context.finger)) leave_unstable(context, selection);
  if (selection.group == SeedGroup::none ||
      (selection.found() && implausible(context, search, selection.result.best, selection.value)))
    face_the_finger(context, search, selection);
}

}  // namespace

SeedResult seed_contact(ContactContext& context, const SearchStructures& search, const TrackedPlane& kept, bool in_vain,
                        Clearance* parts, const EnteredPlaces& entered) {
  SeedSelection selection{entered};
  if (context.settings.method != Method::robust) {
    seed_by_distance(context, search, 1, known_radius(context, kept), context.settings.max_iterations, nullptr, false,
                     selection);
  } else {
    seed_robustly(context, search, kept, in_vain, parts, selection);
  }
  context.seed = 0;
  if (context.settings.method == Method::robust && selection.group == SeedGroup::unstable) {
    // Every contact there is unstable. A sphere touches all round (at another one's centre, say): any will do. Others
    // would leave theirs, as on a saddle: the surface offers none, and the nearest is but the place to face.
    selection.result.found = true;
    selection.result.best.stop = is_round(context.finger) ? StopReason::converged : StopReason::facing;
  }
  return selection.result;
}

SeedResult go_on_with_start(ContactContext& context, const SearchStructures& search, const IterationResult* tracked,
                            Clearance& begun) {
  if (!is_under_way(context, begun)) begun = begun_at(context.pose);
  const FingerPose pose{begun.centre, begun.orientation};
  ContactContext there{context.cache, context.settings, context.finger, pose, context.origin};
  IterationResult then;
  if (tracked) lead(there, tracked->plane, then);
  const double most = tracked && then.converged() ? contact_rank(context.finger, then.contact) : kUnlimited;
  FailedStarts failed;
  const EnteredPlaces all;
  SeedSelection selection{all};
  begun.under_way =
      !seed_by_hierarchy(there, search, most, tick_work(kLateStartWork, 1.0), begun.next, failed, selection);
  SeedResult result;
  result.searching = begun.under_way != 0;
  result.evaluations = then.evaluations + selection.result.evaluations;
  if (!selection.found()) return result;
  lead(context, selection.result.best.plane, result.best);
  result.evaluations += result.best.evaluations;
  result.found = result.best.converged();
  return result;
}

}  // namespace tangent
