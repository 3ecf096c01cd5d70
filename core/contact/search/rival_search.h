// One search for deeper places from one pose: of everything, or of the watched triangles whose time has come.
#pragma once

#include "core/base/tolerances.h"
#include "core/contact/prove/basin.h"
#include "core/contact/prove/triangle_proof.h"
#include "core/contact/search/height_change.h"
#include "core/contact/search/rivals.h"
#include "core/contact/search_work.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace tangent {

/// Some ticks at the finger's present speed, within shares of the tracked contact's rank.
double ticks_ahead_m(double rank, double moved_m, double ticks, double largest = kLargestWatch);

/// What one triangle means for the tracked contact.
struct Look {
  /// How far the centre may go before it must be looked at again.
  double margin_m = std::numeric_limits<double>::infinity();
  bool holds_rival = false;  ///< it holds a contact, or may, that is not deep enough
  bool watch = false;        ///< to be looked at by itself then; otherwise only a search of everything tells
  bool by_rank = false;      ///< it may hold one that does not count yet (PatchExclusion)
};

class RivalSearch {
 public:
  /// The context, structures and contact must outlive it. `closing`: how fast a rank and the bound may come nearer to
  /// each other, in the finger's way; `ahead`: Clearance::ahead; `any_turn`: its proofs shall hold while the finger
  /// turns; `work`: done in this tick already.
  RivalSearch(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
              const RivalQuestion& question, double closing, float ahead, bool any_turn, int work = 0);

  int work() const { return work_; }
  /// A rival is known already.
  void is_deeper_than(const IterationResult& rival) { deepest_ = contact_rank(context_.finger, rival.contact); }

  /// Every triangle that could hold a rival.
  void everywhere(RivalResult& result);
  /// The rest of a search that is under way, of which the clearance tells.
  void go_on(RivalResult& result);
  /// Only the watched triangles whose time has come; `result.clearance` counts from the present pose.
  void once_more(const Gone& gone, RivalResult& result);

 private:
  /// All from a place of the tree on, as far as the tick's work goes; `ahead`: to the middle of the look-ahead.
  void go_on(const VisitPlace& from, const Vec3& ahead, RivalResult& result);
  /// Of the watched triangles the first `kept` have been looked at, those from `from` on not: they come first next.
  static void put_off(std::uint32_t kept, std::uint32_t from, RivalResult& result);
  /// Further ahead where that was cheap and got as far as was asked for, less far where it was dear.
  float adapted(const Clearance& clearance) const;

  static SolverSettings robust(SolverSettings settings);

  static WatchedTriangle watched_triangle(const PartOfTriangle& part, const Look& look);
  static PartOfTriangle part_of(const WatchedTriangle& watched);
  /// Puts a triangle on the list if it is among the soonest. Returns the margin of the one that is not. A heap while it
  /// grows, the latest on top.
  static double watch(Clearance& clearance, const PartOfTriangle& part, const Look& look);

  void remember(const TrackedPlane& plane, const PlaneContact& contact);
  /// Whether a triangle leads to a known contact. Ground under a finger that is not round folds first at the height of
  /// the flattest side that it turns to on the way there, and while it goes as far as is asked.
  bool leads_to(std::size_t i, std::uint32_t t, double margin_m);
  /// Largest radius of curvature of the finger that it turns to a triangle on the way from a support.
  double flattest_height(const CoreSupport& support, std::uint32_t t, double margin_m);
  /// Whether ground may fold at that height, by bounds of its curvature, and be hollow over two triangles by more than
  /// the hysteresis: under a flank as flat as a capsule's places tell nothing of what is between them. Where there are
  /// no such bounds the places have to do.
  bool may_hide_hollow(std::uint32_t t, double height_m);
  /// How far a finger with a core may go before a rival that ranks `gap` behind can overtake: no depth changes faster.
  double overtaking_core_m(double gap) const { return touched_ ? gap : 0.5 * gap; }

  /// The tracked contact, or one that is followed beside it.
  bool is_followed(const Vec3& point) const;

  HeightChange change_of(const TrackedPlane& plane, const SurfaceSample& sample, double height_m) const;
  /// Whether a triangle has one normal all over.
  bool is_even(std::uint32_t t) const;
  /// Whether the face of a triangle holds no other contact than the tracked one, for good: both are parts of one plane
  /// with one normal, as the slivers of a flat cap are, and that has one place under the finger.
  bool continues_tracked_plane(std::uint32_t t) const;
  /// Whether a known contact is the one that a region, a side or a corner may have.
  bool holds_known(const PartOfTriangle& part, const KnownContact& known) const;
  /// Whether a part leads to a known contact. Of what is beside the edge or corner that it is on nothing is taken for
  /// granted, since a curved crease may hold another contact, and so may a face beside it; but of a finger that is not
  /// round, whose proofs at corners are dear, the corners of the triangle that it is on are.
  bool is_slope_of(std::size_t i, const PartOfTriangle& part, double margin_m);
  /// `up_to`: rank below which contacts count.
  Look look_at(PartOfTriangle part, double enough_m, const RankBound& up_to, RivalResult& result);

  /// Whether nothing of a part counts in the look-ahead.
  bool excludes_ahead(const PartOfTriangle& part);
  /// Ground that leads to a known contact. Steady ground does so for good, other ground as far as a look-ahead goes.
  Look own_slope(double enough_m) const { return enough_m > slope_m_ ? Look{slope_m_} : Look{}; }

  /// The steady ground that a contact may have come to from these triangles since the last tick.
  void look_beside(std::span<const std::uint32_t> triangles, RivalResult& result);

  bool meets_steady_ground(std::uint32_t t, const ContactQuery& q);

  ContactQuery query(double margin) const;
  /// What can take over within a margin. Beside a contact on the outside, a place seen from inside that a finger other
  /// than a point comes to was not entered (decide.h).
  void limit(ContactQuery& q, double margin) const;

  void narrow(Clearance& clearance, double margin, ContactQuery& q) const;

  void narrow_ahead(Clearance& clearance, double margin, ContactQuery& q, const Vec3& ahead);
  /// From here to the middle of the look-ahead: a finger mostly goes on as it has come.
  Vec3 lead() const;
  /// What is left of the look-ahead where the finger can't go further than this share of margin_m_ anyway: the ball
  /// shrinks about the finger, so that it stays within what it was.
  void set_ahead(ContactQuery& q, const Vec3& ahead, double share);
  /// There a triangle without a contact, deeper or not yet, stays without until one comes in over the border.
  Look look_at_steady(const PartOfTriangle& part, double margin, RivalResult& result);
  Look look_at(const PartOfTriangle& part, double enough_m, RivalResult& result);
  /// Seen from the next triangle, the tracked contact on or near their common side. What faces elsewhere is another
  /// one: the other wall of a corner, as deep, may be as near where triangles are large.
  bool is_tracked(std::uint32_t t, const PatchExclusion& proof);
  /// Whether the place that may hold a contact is known, and so near to that point that it may be the same.
  bool is_beside(const PatchExclusion& proof, const Vec3& point) const;
  /// Round fingers. A place that is none of the contact's slope is told by its height: near a contact it changes
  /// little.
  static bool is_as_high(const PatchExclusion& proof, double height_m);

  Look solve(const PartOfTriangle& part, const PatchExclusion& proof, double enough_m, RivalResult& result);

  Look solve_from(const PartOfTriangle& part, const PatchExclusion& proof, double enough_m, RivalResult& result);
  /// To the deeper of the contacts beside an unstable one that are not followed yet; to one that is, where there is no
  /// other.
  void look_beyond_fold(int budget, IterationResult& r, int& evaluations);

  const SearchStructures search_;
  const IterationResult& tracked_;
  const TouchedContacts* touched_;
  double bound_m_, closing_, margin_m_;
  float ahead_;
  bool any_turn_;   ///< proofs shall hold while the finger turns, too
  double slope_m_;  ///< how far ahead ground that is not steady is taken for a known contact's slope
  double least_m_;  ///< how far ahead a search looks however dear that is
  double deepest_;
  SolverSettings settings_;
  double tracked_rank_m_;
  bool tracked_is_even_ = false;
  bool steady_;  ///< contacts are followed over steady ground
  int work_;     ///< of this tick so far
  SearchWork cost_;
  int most_work_;
  std::optional<FingerCore> core_, core_ahead_;  ///< of a finger that is not round; in the middle of the look-ahead
  ContactContext context_;
  HeightChange change_;    ///< of the tracked contact
  FingerPose ahead_pose_;  ///< the middle of the look-ahead, its radius (0: it is about the finger), what counts there
  double ahead_m_ = 0.0, ahead_bound_m_ = 0.0;
  ContactContext context_ahead_;  ///< of glances from there
  std::array<KnownContact, kKnownContacts> known_;
  std::array<double, kKnownContacts> known_depths_;
  std::size_t known_count_ = 0;
  int solves_ = 0;
  int dear_looks_ = 0;  ///< those that took more than a glance
};

}  // namespace tangent
