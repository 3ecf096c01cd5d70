#include "core/contact/search/rival_search.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/prove/clearance_check.h"
#include "core/contact/prove/core_proof.h"
#include "core/contact/search/beyond_fold.h"

#include <algorithm>

namespace tangent {
namespace {

/// Ratio to the distance: so far off a plane triangles are still parts of it. Rounding leaves 1e-16.
constexpr double kSamePlane = 1e-12;
/// Of the finger's reach: so large a radius of curvature is a flat side.
constexpr double kFlatFlank = 4.0;
constexpr double kForever = std::numeric_limits<double>::infinity();

/// Whether a contact is well enough known without solving for it. Beside a fold a stable and an unstable one are so
/// near to each other that it may be either.
bool trusts_guess(const Stability& stability) { return stability.det > kGuessMinDet && stability.trace > 0.0; }

double distance2(const Vec3& a, const Vec3& b) { return glm::dot(a - b, a - b); }

}  // namespace

double ticks_ahead_m(double rank, double moved_m, double ticks, double largest) {
  // Where not even one tick ahead can be seen, as after a leap, looking ahead would be for nothing.
  const double most = largest * std::abs(rank);
  return (moved_m < most ? std::min(ticks * moved_m, most) : 0.0) + kSmallestWatch * std::abs(rank);
}

RivalSearch::RivalSearch(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
                         const RivalQuestion& question, double closing, float ahead, bool any_turn, int work)
    : search_(search),
      tracked_(tracked),
      touched_(question.touched),
      bound_m_(question.bound_m),
      closing_(closing),
      margin_m_(question.margin_m),
      ahead_(ahead),
      any_turn_(any_turn),
      slope_m_(
          ticks_ahead_m(contact_rank(context.finger, tracked.contact), context.moved_m, kSlopeTicks, kLargestSlope)),
      least_m_(ticks_ahead_m(contact_rank(context.finger, tracked.contact), context.moved_m, kDearTicks)),
      deepest_(question.bound_m),
      settings_(robust(context.settings)),
      tracked_rank_m_(contact_rank(context.finger, tracked.contact)),
      steady_(settings_.normal_form == NormalForm::bernstein),
      work_(work),
      cost_(is_round(context.finger) ? SearchWork::of_round() : SearchWork::of_core()),
      most_work_(tick_work(cost_.late, context.late_m / context.hystereses_m(cost_.most_late))),
      context_{context.cache, settings_, context.finger,  context.pose, context.origin,
               context.trace, 0,         context.moved_m, context.moved},
      context_ahead_{context.cache, settings_, context.finger, ahead_pose_, context.origin} {
  if (!is_round(context.finger)) {
    context_.core = &core_.emplace(context.finger, context.pose, any_turn_);
    steady_ = steady_ && can_ask_steady(*core_, tracked_rank_m_);
  }
  context_.most_crossings = kMostRivalCrossings;
  context_.far_ahead = ahead > 1.0f;
  remember(tracked.plane, tracked.contact);
  change_ = change_of(tracked.plane, tracked.sample, tracked.contact.height_m);
  tracked_is_even_ = tracked.plane.feature == Feature::face && is_even(tracked.plane.triangle);
  if (touched_)
    for (const TouchedContact& c : touched_->all()) remember(c.plane, c.contact);
}

void RivalSearch::everywhere(RivalResult& result) {
  result.clearance.any_turn = any_turn_;
  go_on({}, lead(), result);
}

void RivalSearch::go_on(RivalResult& result) {
  const Clearance& begun = result.clearance;
  go_on(begun.next, begun.ahead_centre - begun.centre, result);
  result.clearance.ahead = std::max(kLeastAhead, 0.5f * ahead_);
}

void RivalSearch::once_more(const Gone& gone, RivalResult& result) {
  Clearance& clearance = result.clearance;
  std::uint32_t kept = 0, passed_count = 0, at = 0;
  std::array<std::uint32_t, Clearance::kWatched> passed;  // a contact may have gone on from there to steady ground
  const std::uint32_t count = clearance.watched_count;
  for (; at < count && work_ < most_work_; ++at) {
    const WatchedTriangle watched = clearance.watched[at];
    if (watched.margin_m > 0.0f) {
      clearance.watched[kept++] = watched;
      continue;
    }
    const PartOfTriangle part = part_of(watched);
    // What could neither be proved nor be solved for is looked at every tick: closely only by the next search.
    context_.brief = core_ && watched.holds_rival;
    const Look look = look_at(part, clearance.margin_m, result);
    context_.brief = false;
    const double then_m = watched.margin_m + gone.now_m;
    const bool held_none = !watched.holds_rival && !look.holds_rival && !look.by_rank &&
                           stayed_within(then_m, gone.before_m, gone.now_m, look.margin_m, context_.moved_m);
    if (!held_none && !(watched.holds_rival && look.holds_rival)) passed[passed_count++] = watched.triangle;
    if (!look.watch) clearance.margin_m = std::min(clearance.margin_m, look.margin_m);
    if (look.watch && look.margin_m < clearance.margin_m) clearance.watched[kept++] = watched_triangle(part, look);
  }
  put_off(kept, at, result);
  if (steady_ && passed_count > 0) look_beside(std::span(passed).first(passed_count), result);
  set_free(clearance);
}

void RivalSearch::go_on(const VisitPlace& from, const Vec3& ahead, RivalResult& result) {
  Clearance& clearance = result.clearance;
  clearance.margin_m = margin_m_;
  clearance.next = from;
  int patience = kDearLooks;
  ContactQuery all = query(margin_m_);
  all.work = work_;
  all.most_work = most_work_;
  set_ahead(all, ahead, 1.0);
  const auto visit = [&](std::uint32_t t, ContactQuery& q) {
    const int before = work_;
    const PartOfTriangle part{t, q.part};
    if (dear_looks_ >= patience && clearance.margin_m > least_m_) {  // rather again soon than all this way now
      patience += kDearLooks;
      narrow_ahead(clearance, std::max(least_m_, 0.5 * clearance.margin_m), q, ahead);
    }
    const double way = clearance.margin_m;
    const Look look = q.here_m < q.margin_m ? look_at_steady(part, way, result) : look_at(part, way, result);
    const double margin = look.watch ? watch(clearance, part, look) : look.margin_m;
    if (margin < way) narrow_ahead(clearance, margin, q, ahead);
    q.work += work_ - before;
    return true;
  };
  clearance.under_way = !search_.hierarchy.visit_from(clearance.next, all, visit);
  work_ = all.work;
  result.searching = clearance.under_way != 0;
  const double off = std::sqrt(glm::dot(ahead, ahead)), share = clearance.margin_m / margin_m_;
  clearance.ahead_centre = context_.pose.position + share * ahead;
  clearance.height_m = closing_ > 1.0 ? kForever : bound_m_;
  if (clearance.under_way) {
    clearance.ahead_height_m = bound_m_;
    clearance.free_m = -1.0;
    return;
  }
  clearance.ahead_m = share * (margin_m_ - off) * (1.0 - 1e-6);
  clearance.ahead_height_m = bound_m_ + share * ((closing_ - 1.0) * off + closing_ * (margin_m_ - off));
  clearance.ahead = adapted(clearance);
  set_free(clearance);
}

void RivalSearch::put_off(std::uint32_t kept, std::uint32_t from, RivalResult& result) {
  Clearance& clearance = result.clearance;
  const auto first = clearance.watched.begin();
  const auto rest = std::copy(first + from, first + clearance.watched_count, first + kept);
  const auto due = [](const WatchedTriangle& watched) { return !(watched.margin_m > 0.0f); };
  result.searching = std::any_of(first + kept, rest, due);
  std::rotate(first, first + kept, rest);
  clearance.watched_count = static_cast<std::uint32_t>(rest - first) & 0xFFFFu;
}

float RivalSearch::adapted(const Clearance& clearance) const {
  if (dear_looks_ > kDearLooks) return std::max(kLeastAhead, 0.5f * ahead_);
  const bool got_there = clearance.watched_count == 0 && clearance.margin_m >= margin_m_;
  return dear_looks_ <= kCheapLooks && got_there ? std::min(kMostAhead, 2.0f * ahead_) : ahead_;
}

SolverSettings RivalSearch::robust(SolverSettings settings) {
  settings.method = Method::robust;
  return settings;
}

WatchedTriangle RivalSearch::watched_triangle(const PartOfTriangle& part, const Look& look) {
  return {part.triangle & 0xFFFFFFFu, static_cast<std::uint32_t>(part.part) & 7u, look.holds_rival || look.by_rank,
          static_cast<float>(look.margin_m)};
}

PartOfTriangle RivalSearch::part_of(const WatchedTriangle& watched) {
  return {watched.triangle, static_cast<SearchPart>(std::uint32_t{watched.part})};
}

double RivalSearch::watch(Clearance& clearance, const PartOfTriangle& part, const Look& look) {
  const double margin = look.margin_m;
  if (margin >= clearance.margin_m) return margin;
  const auto sooner = [](const WatchedTriangle& a, const WatchedTriangle& b) { return a.margin_m < b.margin_m; };
  const auto first = clearance.watched.begin();
  double dropped = kForever;
  if (clearance.watched_count == Clearance::kWatched) {
    if (margin >= first->margin_m) return margin;
    dropped = first->margin_m;
    std::pop_heap(first, clearance.watched.end(), sooner);
    --clearance.watched_count;
  }
  first[clearance.watched_count++] = watched_triangle(part, look);
  std::push_heap(first, first + clearance.watched_count, sooner);
  return dropped;
}

void RivalSearch::remember(const TrackedPlane& plane, const PlaneContact& contact) {
  if (known_count_ == known_.size()) return;
  known_depths_[known_count_] = contact.penetration_m;
  known_[known_count_++] = known_contact(context_.cache.mesh(), plane, contact.height_m);
}

bool RivalSearch::leads_to(std::size_t i, std::uint32_t t, double margin_m) {
  work_ += cost_.slope;
  if (!core_) return same_basin(context_.cache, settings_.normal_form, t, known_[i], margin_m);
  KnownContact known = known_[i];
  if (known.height_m >= 0.0) {
    const CoreSupport support = core_->support(known.normal);
    known.height_m = std::max(known.height_m, flattest_height(support, t, margin_m) - known_depths_[i]);
    if (known.height_m > kFlatFlank * core_->reach_m() && t != known.triangle) {
      const double there = flattest_height(support, known.triangle, margin_m) - known_depths_[i];
      if (may_hide_hollow(t, known.height_m) || may_hide_hollow(known.triangle, there)) return false;
    }
  }
  return same_basin(context_.cache, settings_.normal_form, t, known, margin_m);
}

double RivalSearch::flattest_height(const CoreSupport& support, std::uint32_t t, double margin_m) {
  const PnPatch& patch = context_.cache.patch(t, settings_.normal_form);
  const Vec3 to_point = core_->centre() - support.point;  // |A N| is N's part along it, or more
  double least = support.length;
  for (std::size_t k = 0; k < patch.normals.size(); ++k) {
    const double share = k < n110 ? 1.0 : 0.5 * patch.mixed_weight;
    least = std::min(least, share * glm::dot(patch.normals[k], to_point));
  }
  return core_->ball_m() + core_->largest_radius(core_->length_after(least, margin_m));
}

bool RivalSearch::may_hide_hollow(std::uint32_t t, double height_m) {
  const double least = context_.cache.bend(t, settings_.normal_form).least;
  const auto p = context_.cache.mesh().positions(t);
  const double wide2 = std::max({distance2(p[0], p[1]), distance2(p[1], p[2]), distance2(p[2], p[0])});
  return least > -kForever && least * height_m <= -kFoldRoom && -0.5 * least * wide2 > settings_.switch_hysteresis_m;
}

bool RivalSearch::is_followed(const Vec3& point) const {
  const double same = kMergedPlaces * settings_.tolerance_m;
  const auto near = [&](const Vec3& other) { return glm::dot(point - other, point - other) <= same * same; };
  if (near(tracked_.plane.point)) return true;
  if (!touched_) return false;
  const auto all = touched_->all();
  return std::any_of(all.begin(), all.end(), [&](const TouchedContact& c) { return near(c.plane.point); });
}

HeightChange RivalSearch::change_of(const TrackedPlane& plane, const SurfaceSample& sample, double height_m) const {
  const bool face = plane.feature == Feature::face && is_round(context_.finger);
  return face ? height_change_on_face(sample, height_m) : height_change_along(plane.normal, height_m);
}

bool RivalSearch::is_even(std::uint32_t t) const {
  const ContactMesh& mesh = context_.cache.mesh();
  const Vec3& n = mesh.normal(t, 0);
  return mesh.normal(t, 1) == n && mesh.normal(t, 2) == n;
}

bool RivalSearch::continues_tracked_plane(std::uint32_t t) const {
  const ContactMesh& mesh = context_.cache.mesh();
  const std::uint32_t tracked = tracked_.plane.triangle;
  if (!tracked_is_even_ || !is_even(t) || mesh.normal(t, 0) != mesh.normal(tracked, 0)) return false;
  const Vec3 &n = mesh.normal(t, 0), &p = mesh.position(tracked, 0);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 d = mesh.position(t, k) - p;
    if (std::abs(glm::dot(d, n)) > kSamePlane * std::sqrt(glm::dot(d, d))) return false;
  }
  return true;
}

bool RivalSearch::holds_known(const PartOfTriangle& part, const KnownContact& known) const {
  const ContactMesh& mesh = context_.cache.mesh();
  const std::uint32_t t = part.triangle;
  if (part.part == SearchPart::region)
    return known.feature == Feature::face && mesh.flat_regions().of(known.triangle) == mesh.flat_regions().of(t);
  if (known.feature == Feature::edge && is_side(part.part)) {
    const std::uint32_t k = side_of(part.part);
    const EdgeLink other = mesh.across(t, k);
    return (known.triangle == t && known.side == k) || (known.triangle == other.triangle && known.side == other.edge);
  }
  if (known.feature != Feature::vertex || part.part == SearchPart::face) return false;
  const std::uint32_t vertex = mesh.vertex(known.triangle, known.side);
  return is_corner(part.part) && mesh.vertex(t, corner_of(part.part)) == vertex;
}

bool RivalSearch::is_slope_of(std::size_t i, const PartOfTriangle& part, double margin_m) {
  const KnownContact& known = known_[i];
  if (part.part == SearchPart::face) return leads_to(i, part.triangle, margin_m);
  if (holds_known(part, known)) return true;
  if (!core_ || !is_corner(part.part)) return false;
  const ContactMesh& mesh = context_.cache.mesh();
  const std::uint32_t vertex = mesh.vertex(part.triangle, corner_of(part.part));
  return mesh.vertex(known.triangle, 0) == vertex || mesh.vertex(known.triangle, 1) == vertex ||
         mesh.vertex(known.triangle, 2) == vertex;
}

Look RivalSearch::look_at(PartOfTriangle part, double enough_m, const RankBound& up_to, RivalResult& result) {
  const std::uint32_t t = part.triangle;
  if (!core_ && part.part == SearchPart::face && continues_tracked_plane(t)) return {};
  work_ += cost_.look;
  const bool looks_ahead = enough_m > 0.0 && ahead_m_ > 0.0 && part.part != SearchPart::region;
  if (part.part == SearchPart::face) ++dear_looks_;
  if (looks_ahead && excludes_ahead(part)) return {};
  if (part.part != SearchPart::face) ++dear_looks_;
  for (std::size_t i = 0; i < known_count_; ++i)
    if (is_slope_of(i, part, std::min(enough_m, slope_m_)))
      return part.part == SearchPart::region ? Look{} : own_slope(enough_m);
  const PatchExclusion proof = exclude_part(context_, part, up_to, enough_m);
  work_ += cost_.test * proof.tests;
  if (!proof.possible && proof.margin_m > 0.0) return {proof.margin_m, false, true, proof.by_rank};
  if (!proof.possible) return {kUnresolvedMargin * slope_m_, true, true};
  if (proof.height_m != 0.0 && is_tracked(t, proof)) return own_slope(enough_m);
  const double guess = proof.height_m >= 0.0 ? proof.height_m : context_.finger.reach_m() - proof.height_m;
  const double behind = guess - bound_m_;
  if (proof.height_m != 0.0 && behind > kHeightGuess * guess) {  // a rival, but not a deeper one yet
    if (core_)
      return {std::min(overtaking_core_m(behind), proof.unsure ? kUnresolvedMargin * slope_m_ : kForever), true, true};
    SurfaceSample there;
    context_.cache.sample(t, settings_.normal_form, proof.u, std::min(proof.v, 1.0 - proof.u), there);
    if (trusts_guess(normal_bend(there).at_height(proof.height_m)))
      return {overtaking_margin(change_, height_change_on_face(there, proof.height_m), behind, touched_ != nullptr),
              true, true};
  }
  return solve(part, proof, enough_m, result);
}

bool RivalSearch::excludes_ahead(const PartOfTriangle& part) {
  work_ += cost_.glance;
  int tests = 0;
  const bool excluded = excludes_at_a_glance(context_ahead_, core_ ? &*core_ahead_ : nullptr, part,
                                             {ahead_bound_m_, closing_}, ahead_m_, tests);
  if (!core_) work_ += cost_.test * tests;
  return excluded;
}

void RivalSearch::look_beside(std::span<const std::uint32_t> triangles, RivalResult& result) {
  Clearance& clearance = result.clearance;
  ContactQuery beside = query(clearance.margin_m);
  const double moved = core_ ? core_->slide_m(core_->longest_m(), 0.0, context_.moved_m) : context_.moved_m;
  const Vec3 most(moved / (kSteadyRoom - kSteadyLean));  // the fastest that it goes there
  for (const std::uint32_t t : triangles) {
    if (!meets_steady_ground(t, beside)) continue;
    const PnPatch& patch = context_.cache.patch(t, settings_.normal_form);
    for (std::size_t i = 0; i < patch.offsets.size(); ++i) {
      beside.region.include(patch.control_point(i) + most);
      beside.region.include(patch.control_point(i) - most);
    }
  }
  if (beside.region.empty()) return;
  beside.steady_only = true;
  beside.work = work_;
  beside.most_work = 2 * most_work_;
  VisitPlace from;
  const auto visit = [&](std::uint32_t other, ContactQuery& q) {
    const int before = work_;
    const Look look = look_at_steady({other, q.part}, q.margin_m, result);
    if (look.margin_m < clearance.margin_m) narrow(clearance, look.margin_m, q);
    q.work += work_ - before;
    return true;
  };
  const bool through = search_.hierarchy.visit_from(from, beside, visit);
  work_ = beside.work;
  if (through) return;
  clearance.margin_m = 0.0;  // the next tick looks everywhere
  result.searching = true;
}

bool RivalSearch::meets_steady_ground(std::uint32_t t, const ContactQuery& q) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t other = context_.cache.mesh().across(t, k).triangle;
    if (other == kNone) continue;
    const CurvatureBounds& bend = context_.cache.bend(other, settings_.normal_form);
    if (core_ ? may_be_steady_for_core(q, bend.least, context_.cache.patch(other, settings_.normal_form))
              : is_steady(q, bend.least, bend.greatest))
      return true;
  }
  return false;
}

ContactQuery RivalSearch::query(double margin) const {
  ContactQuery q;
  q.centre = context_.pose.position;
  q.margin_m = margin;
  q.tilt_rad = context_.finger.tilt_rad();
  q.steady_ground = steady_;
  q.core = context_.core;
  limit(q, margin);
  return q;
}

void RivalSearch::limit(ContactQuery& q, double margin) const {
  limit_query(q, context_.finger, bound_m_ + closing_ * margin, margin);
  if (core_ && tracked_.contact.height_m >= 0.0) q.inside_m = -1.0;
}

void RivalSearch::narrow(Clearance& clearance, double margin, ContactQuery& q) const {
  clearance.margin_m = q.margin_m = margin;
  limit(q, margin);
}

void RivalSearch::narrow_ahead(Clearance& clearance, double margin, ContactQuery& q, const Vec3& ahead) {
  clearance.margin_m = margin;
  limit(q, margin);
  set_ahead(q, ahead, margin / margin_m_);
}

Vec3 RivalSearch::lead() const {
  const double moved = context_.moved_m;
  if (!(moved > 0.0) || moved >= kLargestWatch * std::abs(tracked_rank_m_)) return Vec3(0.0);
  return std::min(kLead * margin_m_ / moved, kLeadTicks) * context_.moved;
}

void RivalSearch::set_ahead(ContactQuery& q, const Vec3& ahead, double share) {
  q.ahead = share * ahead;
  q.margin_m = share * (margin_m_ - std::sqrt(glm::dot(ahead, ahead)));
  ahead_pose_.position = context_.pose.position + q.ahead;
  ahead_m_ = ahead == Vec3(0.0) ? 0.0 : q.margin_m;
  ahead_bound_m_ = bound_m_ + (closing_ - 1.0) * std::sqrt(glm::dot(q.ahead, q.ahead));
  if (!core_ || ahead_m_ == 0.0) return;
  core_ahead_ = *core_;
  core_ahead_->move_to(ahead_pose_.position);
  q.core_ahead = &*core_ahead_;
}

Look RivalSearch::look_at_steady(const PartOfTriangle& part, double margin, RivalResult& result) {
  const Look look = look_at(part, 0.0, {bound_m_ + closing_ * margin, closing_}, result);
  return look.holds_rival ? Look{look.margin_m, true, false} : Look{};
}

Look RivalSearch::look_at(const PartOfTriangle& part, double enough_m, RivalResult& result) {
  return look_at(part, enough_m, {bound_m_, closing_}, result);
}

bool RivalSearch::is_tracked(std::uint32_t t, const PatchExclusion& proof) {
  const Vec3 apart = proof.point - tracked_.plane.point;
  const double near = kSamePlace * known_[0].size_m, height = core_ ? tracked_rank_m_ : tracked_.contact.height_m;
  if (!(glm::dot(apart, apart) < near * near) || !(std::abs(proof.height_m - height) < kHeightGuess * std::abs(height)))
    return false;
  SurfaceSample there;
  context_.cache.sample(t, settings_.normal_form, proof.u, std::min(proof.v, 1.0 - proof.u), there);
  return glm::dot(there.normal, tracked_.plane.normal) > kJumpCosine;
}

bool RivalSearch::is_beside(const PatchExclusion& proof, const Vec3& point) const {
  constexpr double kNear = 0.25;  // of a side
  const Vec3 apart = proof.point - point;
  const double near = kNear * known_[0].size_m;
  return proof.height_m != 0.0 && glm::dot(apart, apart) < near * near;
}

bool RivalSearch::is_as_high(const PatchExclusion& proof, double height_m) {
  return std::abs(proof.height_m - height_m) < kHeightGuess * std::abs(height_m);
}

Look RivalSearch::solve(const PartOfTriangle& part, const PatchExclusion& proof, double enough_m, RivalResult& result) {
  const int before = result.evaluations;
  const Look look = solve_from(part, proof, enough_m, result);
  work_ += cost_.evaluation * (result.evaluations - before);
  return look;
}

Look RivalSearch::solve_from(const PartOfTriangle& part, const PatchExclusion& proof, double enough_m,
                             RivalResult& result) {
  context_.seed = static_cast<std::uint8_t>(std::min(++solves_, 255));
  const SurfacePlace start = start_on(context_, part, proof);
  IterationResult r;
  // On the side of a long finger normals turn only so far at a time.
  const bool interior = context_.cache.mesh().interior(part.triangle);
  const int share = !interior ? 2 : core_ ? 4 : 1;
  iterate(context_, start, share * kRivalBudget, r);
  result.evaluations += r.evaluations;
  // Whatever it is called: on a boundary, say, it is left_boundary.
  const bool ran_out = !r.converged() && r.stop != StopReason::unstable && r.evaluations >= share * kRivalBudget;
  if (ran_out && contact_rank(context_.finger, r.contact) < deepest_) {
    const TrackedPlane so_far = r.plane;
    iterate(context_, so_far, share * kDeeperRivalBudget, r);
    result.evaluations += r.evaluations;
  }
  if (core_ && r.stop == StopReason::unstable) look_beyond_fold(share * kDeeperRivalBudget, r, result.evaluations);
  // No contact there now, but one may come up: ask again before long.
  if (!r.converged()) return {kUnresolvedMargin * slope_m_, true, true};
  if (is_followed(r.plane.point)) {
    // Beside a fold a solve may run past a contact, or where one is about to come up, to the tracked one.
    // Solves of fingers that are not round are dear: beside creases they are not repeated.
    const bool ran_past = (!core_ && part.part != SearchPart::face) ||
                          ((!core_ || interior) && r.plane.triangle != part.triangle &&
                           !(is_beside(proof, r.plane.point) && (core_ || is_as_high(proof, r.contact.height_m))));
    if (ran_past) return {kUnresolvedMargin * slope_m_, true, true};
    return own_slope(enough_m);
  }
  remember(r.plane, r.contact);
  const double rank = contact_rank(context_.finger, r.contact);
  if (touched_ && rank < bound_m_ && pushes_with_others(r.contact)) {
    result.touched.add({r.plane, r.contact}, kMergedPlaces * settings_.tolerance_m);
    // From now on it is followed, where there is room for it.
    if (touched_->count + result.touched.count <= kMostTouched) return own_slope(enough_m);
  }
  // Where others push, too, those are told of above, and what takes over is a place that does not push with them.
  const bool is_told = core_ && touched_ && pushes_with_others(r.contact);
  if (rank < deepest_ && !is_told) {
    deepest_ = rank;
    result.best = r;
    result.deeper = true;
  }
  const double behind = std::max(0.0, rank - bound_m_);
  if (core_) return {overtaking_core_m(behind), true, false};
  return {overtaking_margin(change_, change_of(r.plane, r.sample, r.contact.height_m), behind, touched_ != nullptr),
          true, false};
}

void RivalSearch::look_beyond_fold(int budget, IterationResult& r, int& evaluations) {
  const IterationResult unstable = r;
  bool is_new = false;
  for (const double sign : {-1.0, 1.0}) {
    IterationResult there;
    const bool found = iterate_beyond_fold(context_, unstable, sign, budget, there);
    evaluations += there.evaluations;
    if (!found) continue;
    const bool followed = is_followed(there.plane.point);
    const bool deeper = contact_rank(context_.finger, there.contact) < contact_rank(context_.finger, r.contact);
    if (followed ? !r.converged() : !is_new || deeper) r = there;
    is_new = is_new || !followed;
  }
}

}  // namespace tangent
