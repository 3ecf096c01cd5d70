#include "core/contact/search/rivals.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"
#include "core/contact/nearest_triangles.h"
#include "core/contact/prove/basin.h"
#include "core/contact/prove/clearance_check.h"
#include "core/contact/prove/triangle_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

Vec3 interpolated_normal(const ContactMesh& mesh, std::uint32_t t, double u, double v) {
  const auto n = mesh.normals(t);
  return unit((1.0 - u - v) * n[0] + u * n[1] + v * n[2]);
}

/// How far the centre may go before a rival that ranks `gap` behind can overtake: heights change along their normals,
/// and in second order by the square of the way over the height, near a fold by more.
/// `is_still`: the bound is a fixed height, and not the tracked contact's.
double overtaking_margin(const KnownContact& tracked, const Vec3& rival_normal, double rival_height, double gap,
                         bool is_still) {
  const Vec3 apart = is_still ? rival_normal : tracked.normal - rival_normal;
  const double rate = std::sqrt(glm::dot(apart, apart)) + 1e-3;
  const double bend = 2.0 / std::max(1e-12, std::min(std::abs(tracked.height_m), std::abs(rival_height)));
  // Smaller root of rate m + bend m^2 = gap.
  return kOvertakingRoom * 2.0 * gap / (rate + std::sqrt(rate * rate + 4.0 * bend * gap));
}

/// What one triangle means for the tracked contact.
struct Look {
  double margin_m = kForever;  ///< how far the centre may go before it must be looked at again
  bool contact = false;        ///< it holds a contact, whose surroundings are left out of the search on its behalf
};

class RivalSearch {
 public:
  RivalSearch(ContactContext& context, const SearchStructures& search, const IterationResult& tracked, double bound_m,
              double margin_m, const TouchedContacts* touched)
      : search_(search),
        tracked_(tracked),
        touched_(touched),
        bound_m_(bound_m),
        margin_m_(margin_m),
        deepest_(bound_m),
        settings_(robust(context.settings)),
        context_{context.cache, settings_, context.finger, context.pose, context.origin, context.trace, 0} {
    remember(tracked.plane, tracked.contact);
    if (touched)
      for (const TouchedContact& c : touched->all()) remember(c.plane, c.contact);
  }

  /// Every triangle that could hold a rival.
  void everywhere(RivalResult& result) {
    Clearance& clearance = result.clearance;
    clearance.margin_m = margin_m_;
    ContactQuery query;
    query.centre = context_.pose.position;
    query.margin_m = margin_m_;
    query.tilt_rad = context_.finger.tilt_rad();
    limit_query(query, context_.finger, bound_m_ + 2.0 * margin_m_);
    search_.hierarchy.visit(query, [&](std::uint32_t t, ContactQuery& q) {
      const Look look = look_at(t, q.margin_m, result);
      const double margin = look.contact ? look.margin_m : watch(clearance, t, look.margin_m);
      if (margin < clearance.margin_m) {
        clearance.margin_m = q.margin_m = margin;
        limit_query(q, context_.finger, bound_m_ + 2.0 * margin);
      }
      return solves_ < kMaxSolves;
    });
    clearance.height_m = bound_m_ + 2.0 * clearance.margin_m;
    if (solves_ >= kMaxSolves) clearance.margin_m = 0.0;
    set_free(clearance);
  }

  /// Only the watched triangles whose time has come; `result.clearance` counts from the present pose.
  void once_more(RivalResult& result) {
    Clearance& clearance = result.clearance;
    std::uint32_t kept = 0;
    for (const WatchedTriangle& watched : clearance.on_watch()) {
      if (watched.margin_m > 0.0f) {
        clearance.watched[kept++] = watched;
        continue;
      }
      const Look look = look_at(watched.triangle, clearance.margin_m, result);
      if (look.contact) clearance.margin_m = std::min(clearance.margin_m, look.margin_m);
      if (!look.contact && look.margin_m < clearance.margin_m)
        clearance.watched[kept++] = {watched.triangle, static_cast<float>(look.margin_m)};
    }
    clearance.watched_count = kept;
    set_free(clearance);
  }

 private:
  static SolverSettings robust(SolverSettings settings) {
    settings.method = Method::robust;
    return settings;
  }

  /// Puts a triangle on the list if it is among the soonest. Returns the margin of the one that is not. A heap while it
  /// grows, the latest on top.
  static double watch(Clearance& clearance, std::uint32_t t, double margin) {
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
    first[clearance.watched_count++] = {t, static_cast<float>(margin)};
    std::push_heap(first, first + clearance.watched_count, sooner);
    return dropped;
  }

  void remember(const TrackedPlane& plane, const PlaneContact& contact) {
    if (known_count_ == known_.size()) return;
    known_[known_count_++] = known_contact(context_.cache.mesh(), plane, contact.height_m);
  }

  /// The tracked contact, or one that is followed beside it.
  bool is_followed(const Vec3& point) const {
    const double same = kMergedPlaces * settings_.tolerance_m;
    const auto near = [&](const Vec3& other) { return glm::dot(point - other, point - other) <= same * same; };
    if (near(tracked_.plane.point)) return true;
    if (!touched_) return false;
    const auto all = touched_->all();
    return std::any_of(all.begin(), all.end(), [&](const TouchedContact& c) { return near(c.plane.point); });
  }

  Look look_at(std::uint32_t t, double enough_m, RivalResult& result) {
    const ContactMesh& mesh = context_.cache.mesh();
    for (std::size_t i = 0; i < known_count_; ++i)
      if (same_basin(context_.cache, settings_.normal_form, t, known_[i], enough_m)) return {};
    const PatchExclusion proof = exclude_triangle(context_, t, bound_m_, enough_m, &features_);
    if (!proof.possible) return {proof.margin_m > 0.0 ? proof.margin_m : kUnresolvedMargin * margin_m_, false};
    if (proof.height_m != 0.0 && is_tracked(proof)) return {};
    const double guess = proof.height_m >= 0.0 ? proof.height_m : context_.finger.reach_m() - proof.height_m;
    const double behind = guess - bound_m_;
    if (proof.height_m != 0.0 && behind > kHeightGuess * guess)  // a rival, but not a deeper one yet
      return {overtaking_margin(known_[0], interpolated_normal(mesh, t, proof.u, proof.v), proof.height_m, behind,
                                touched_ != nullptr),
              false};
    return solve(t, proof, result);
  }

  /// Seen from the next triangle, the tracked contact on or near their common side.
  bool is_tracked(const PatchExclusion& proof) const {
    const Vec3 apart = proof.point - tracked_.plane.point;
    const double near = kSamePlace * known_[0].size_m;
    return glm::dot(apart, apart) < near * near &&
           std::abs(proof.height_m - tracked_.contact.height_m) < kHeightGuess * std::abs(tracked_.contact.height_m);
  }

  Look solve(std::uint32_t t, const PatchExclusion& proof, RivalResult& result) {
    context_.seed = static_cast<std::uint8_t>(std::min(++solves_, 255));
    const SurfacePlace start = place_on_face(t, proof.u, std::min(proof.v, 1.0 - proof.u));
    IterationResult r;
    const int share = context_.cache.mesh().interior(t) ? 1 : 2;
    iterate(context_, start, share * kRivalBudget, r);
    result.evaluations += r.evaluations;
    if (r.stop == StopReason::iteration_limit && contact_rank(context_.finger, r.contact) < deepest_) {
      const TrackedPlane so_far = r.plane;
      iterate(context_, so_far, share * kDeeperRivalBudget, r);
      result.evaluations += r.evaluations;
    }
    // No contact there now, but one may come up: ask again before long.
    if (!r.converged()) return {kUnresolvedMargin * margin_m_, false};
    if (is_followed(r.plane.point)) return {};
    remember(r.plane, r.contact);
    const double rank = contact_rank(context_.finger, r.contact);
    if (touched_ && rank < bound_m_ && pushes_with_others(r.contact))
      result.touched.add({r.plane, r.contact}, kMergedPlaces * settings_.tolerance_m);
    if (rank < deepest_) {
      deepest_ = rank;
      result.best = r;
      result.deeper = true;
    }
    return {overtaking_margin(known_[0], r.plane.normal, r.contact.height_m, std::max(0.0, rank - bound_m_),
                              touched_ != nullptr),
            true};
  }

  const SearchStructures search_;
  const IterationResult& tracked_;
  const TouchedContacts* touched_;
  double bound_m_, margin_m_, deepest_;
  SolverSettings settings_;
  ContactContext context_;
  FeatureMemory features_;
  std::array<KnownContact, kKnownContacts> known_;
  std::size_t known_count_ = 0;
  int solves_ = 0;
};

}  // namespace

double look_ahead_m(double rank, double moved_m) {
  // Where not even one tick ahead can be seen, as after a leap, looking ahead would be for nothing.
  const double most = kLargestWatch * std::abs(rank);
  const double ahead = moved_m < most ? std::min(kWatchTicks * moved_m, most) : 0.0;
  return ahead + kSmallestWatch * std::abs(rank);
}

RivalResult find_rival(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
                       double bound_m, double margin_m, const Clearance& known, double gone,
                       const TouchedContacts* touched) {
  RivalSearch rivals(context, search, tracked, bound_m, margin_m, touched);
  RivalResult result;
  if (gone > known.margin_m || bound_m > known.height_m - gone) {
    result.clearance.centre = context.pose.position;
    result.clearance.orientation = context.pose.orientation;
    rivals.everywhere(result);
  } else {
    result.clearance = known;
    recentre(result.clearance, context.pose, gone);
    rivals.once_more(result);
  }
  return result;
}

}  // namespace tangent
