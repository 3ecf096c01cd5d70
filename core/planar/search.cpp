#include "core/planar/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

/// Parts a patch is cut into where it is hollow enough towards the finger to hold more than one contact.
constexpr int kParts = 8;
/// The rendered curve bends more than the Bezier by less than this ratio.
constexpr double kBendRoom = 4.0;
/// Patches that one search asks, and lines it looks at: up to 1 ms. Nearer runs are asked first, so what it gives up
/// are patches as near as hundreds of others: a finger at the centre of a circle of 1,000,000 vertices, which all face
/// it.
constexpr int kMostLooks = 512, kMostLines = 16384;
/// Patches that the search for the nearest one compares: 0.2 ms. More of them are as near only about their own centre.
constexpr int kMostNear = 4096;
/// Two contacts nearer to one another than this, in tolerances of the solver, are the same one.
constexpr double kSameContact = 2.0;

/// Smallest radius of curvature of the patch's Bezier, m: |B'|^3 / |B' x B''| where B' is shortest.
double least_radius_m(const CurvePatch& p) {
  const Vec2 l1 = p.vertex - p.first, l2 = p.last - p.vertex, turn = l2 - l1;
  const double t = std::clamp(-glm::dot(l1, turn) / glm::dot(turn, turn), 0.0, 1.0);
  const Vec2 slowest = l1 + t * turn;
  const double speed = glm::length(slowest);
  return 2.0 * speed * speed * speed / std::abs(cross(l1, l2));
}

class PatchSearch {
 public:
  PatchSearch(const PlanarContext& context, std::uint32_t i, PlanarWork& work)
      : x_(context), i_(i), p_(context.curve.patch(i)), work_(work) {}

  bool run(const PlanarRival& rival, PlanarContact& best) {
    double below = rival.below_m;
    bool found = false;
    const auto consider = [&](const PlanarContact& contact) {
      if (!contact.converged() || contact.stability <= 0.0 || std::abs(contact.height_m) >= below) return;
      if (rival.in_front && contact.height_m < 0.0) return;
      if (rival.besides.feature != Feature::none &&
          glm::length(contact.place.point - rival.besides.point) <= kSameContact * x_.settings.tolerance_m)
        return;
      best = contact;
      below = std::abs(contact.height_m);
      found = true;
    };
    PlanarContact corner;
    if (p_.joint_after != CurveJoint::smooth && end_contact(x_, i_, true, corner)) consider(corner);
    if (p_.joint_before == CurveJoint::end && end_contact(x_, i_, false, corner)) consider(corner);
    const bool several = may_hold_several();
    const bool known_here = rival.besides.feature == Feature::face && rival.besides.patch == i_;
    if (!several && known_here) return found;
    for_brackets(several, [&](double low, double high) {
      if (known_here && low <= rival.besides.t && rival.besides.t <= high) return;
      consider(solve_between(low, high));
    });
    return found;
  }

 private:
  /// Parts of the patch where the contact passes from ahead of the line's place to behind it: stable contacts.
  template <class Bracket>
  void for_brackets(bool several, Bracket bracket) {
    const double first = ahead_at_start(p_, x_.centre), last = ahead_at_end(p_, x_.centre);
    const bool one = first >= 0.0 && last <= 0.0;
    if (!several) {
      if (one) bracket(0.0, 1.0);
      return;
    }
    // Both ends point outwards: only an unstable contact is between.
    if (first < 0.0 && last > 0.0) return;
    double before = first;
    for (int k = 1; k <= kParts; ++k) {
      const double t = static_cast<double>(k) / kParts, now = k < kParts ? residual(t) : last;
      if (before >= 0.0 && now <= 0.0) bracket(t - 1.0 / kParts, t);
      before = now;
    }
  }

  /// Two stable contacts, and an unstable one between, take ground that is hollow towards the finger, and a finger
  /// further from it than its centres of curvature.
  bool may_hold_several() const {
    if (p_.straight) return false;
    const bool hollow = x_.curve.side() * cross(p_.vertex - p_.first, p_.last - p_.vertex) > 0.0;
    const bool above = glm::dot(x_.centre - p_.vertex, x_.curve.normal_of(p_.last - p_.first)) > 0.0;
    if (hollow != above) return false;
    const double farthest = std::max(
        {glm::length(x_.centre - p_.first), glm::length(x_.centre - p_.vertex), glm::length(x_.centre - p_.last)});
    return kBendRoom * farthest > least_radius_m(p_);
  }

  double residual(double t) {
    const LineSample s = x_.curve.sample(i_, x_.settings.local_centre, t);
    ++work_.looks;
    const Vec2 contact = s.foot + glm::dot(x_.centre - s.foot, s.direction) * s.direction;
    return glm::dot(contact - s.place, s.direction);
  }

  /// Halves the part until Newton takes it from there.
  PlanarContact solve_between(double low, double high) {
    PlanarContext quiet = x_;
    quiet.trace = nullptr;
    PlanarContact contact;
    for (int halvings = 0; halvings < 48; ++halvings) {
      const double middle = 0.5 * (low + high);
      contact = follow(quiet, {Feature::face, i_, middle, {}, {}}, false, 6);
      work_.evaluations += contact.evaluations;
      const PlanarPlace& at = contact.place;
      const bool inside = at.feature == Feature::face && at.patch == i_ && at.t >= low && at.t <= high;
      if (contact.converged() && inside) return contact;
      (residual(middle) > 0.0 ? low : high) = middle;
    }
    contact.stop = StopReason::iteration_limit;
    return contact;
  }

  const PlanarContext& x_;
  std::uint32_t i_;
  const CurvePatch& p_;
  PlanarWork& work_;
};

}  // namespace

bool nearest_on_patch(const PlanarContext& context, std::uint32_t i, const PlanarRival& rival, PlanarContact& best,
                      PlanarWork& work) {
  return PatchSearch(context, i, work).run(rival, best);
}

bool nearest_contact(const PlanarContext& x, PlanarRival rival, PlanarContact& best, PlanarWork& work) {
  if (!(rival.below_m > 0.0)) return false;
  std::uint32_t holder = kNone;
  double bound2 = rival.below_m * rival.below_m;
  int looks = 0;
  const auto lines = [&] { return work.evaluations + work.looks; };
  const int lines_before = lines();
  x.curve.index().each_facing(x.centre, bound2, [&](std::uint32_t i) {
    const CurvePatch& p = x.curve.patch(i);
    if (p.box.distance2(x.centre) > bound2) return;
    if (x.curve.distance_bound_m(i, x.settings.local_centre, x.centre) > rival.below_m) return;
    if (++looks > kMostLooks || lines() - lines_before > kMostLines) {
      bound2 = -1.0;  // looks no further
      return;
    }
    PlanarRival here = rival;
    if (holder != kNone && i < holder) here.below_m = std::nextafter(rival.below_m, 2.0 * rival.below_m);
    if (!nearest_on_patch(x, i, here, best, work)) return;
    holder = i;
    rival.below_m = std::abs(best.height_m);
    bound2 = rival.below_m * rival.below_m;
  });
  return holder != kNone;
}

std::uint32_t nearest_patch(const PlanarContext& x, double& distance_m) {
  std::uint32_t nearest = kNone;
  double least2 = std::numeric_limits<double>::infinity();
  double bound2 = least2;
  int looks = 0;
  x.curve.index().each_within(x.centre, bound2, [&](std::uint32_t i) {
    const CurvePatch& p = x.curve.patch(i);
    for (const Vec2& at : {p.first, x.curve.bezier(i, 0.5), p.last}) {
      const Vec2 d = x.centre - at;
      const double distance2 = glm::dot(d, d);
      if (distance2 < least2 || (distance2 == least2 && i < nearest)) least2 = distance2, nearest = i;
    }
    bound2 = ++looks < kMostNear ? least2 : -1.0;
  });
  distance_m = std::sqrt(least2);
  return nearest;
}

}  // namespace tangent
