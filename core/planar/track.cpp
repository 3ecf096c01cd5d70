#include "core/planar/track.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

/// New lines a tick may spend on following and on one seed.
constexpr int kTrackLines = 12, kSeedLines = 24;
/// Parts a patch is cut into where both ends point the same way and a concave curve may still hold a contact.
constexpr int kParts = 8;

/// Where the contact of the tangent line at an end lies relative to it: positive beyond P1, in direction of the patch.
double along_first(const PlanarContext& x, const CurvePatch& p) {
  const Vec2 way = p.vertex == p.first ? p.last - p.first : p.vertex - p.first;
  return glm::dot(x.centre - p.first, way);
}
double along_last(const PlanarContext& x, const CurvePatch& p) {
  const Vec2 way = p.vertex == p.last ? p.last - p.first : p.last - p.vertex;
  return glm::dot(x.centre - p.last, way);
}

double distance_bound(const PlanarContext& x, const CurvePatch& p) {
  return std::max(0.0, glm::length(x.centre - p.disc_centre) - p.disc_radius);
}

class Tracker {
 public:
  explicit Tracker(PlanarContext& context) : x_(context) {}

  PlanarTrack run(const PlanarPlace& kept) {
    const bool robust = x_.settings.method == Method::robust;
    const int limit = x_.settings.max_iterations;
    if (kept.feature == Feature::none) {
      out_.event = TickEvent::first;
      find_again(limit);
    } else {
      follow_from(kept, true, robust ? std::min(limit, kTrackLines) : limit);
      if (!out_.converged()) {
        out_.event = TickEvent::reseed;
        find_again(limit);
      } else if (leapt(kept)) {
        out_.event = TickEvent::branch;
      }
    }
    if (out_.converged()) hand_over();
    return out_;
  }

 private:
  void follow_from(const PlanarPlace& start, bool kept, int budget) { take(follow(x_, start, kept, budget)); }
  void take(const PlanarContact& contact) {
    out_.evaluations += contact.evaluations;
    out_.patch_changes += contact.patch_changes;
    out_.contact = contact;
  }

  bool leapt(const PlanarPlace& kept) const {
    return glm::dot(kept.normal, out_.contact.place.normal) < kJumpCosine && out_.patch_changes > 2;
  }

  /// Patches by distance, nearest first; the contact on the nearest that has one.
  void find_again(int limit) {
    const std::uint32_t nearest = nearest_patch();
    ++x_.seed;
    follow_from({Feature::face,
                 nearest,
                 std::clamp(x_.curve.parameter(nearest, x_.settings.local_centre, x_.centre), 0.0, 1.0),
                 {},
                 {}},
                false, x_.settings.method == Method::robust ? kSeedLines : limit);
    if (x_.settings.method != Method::robust || out_.converged()) return;
    PlanarContact best;
    if (search(std::numeric_limits<double>::infinity(), kNone, best)) take_found(best);
  }

  void take_found(const PlanarContact& best) {
    out_.contact = best;
    ++x_.seed;
    // Solved on by itself, so that the trace ends on the contact.
    const PlanarContact again = follow(x_, best.place, true, x_.settings.max_iterations);
    if (again.converged()) out_.contact = again;
  }

  void hand_over() {
    const double mine = std::abs(out_.contact.height_m);
    PlanarContact rival;
    if (!search(mine - x_.settings.switch_hysteresis_m, out_.contact.place.patch, rival)) return;
    take_found(rival);
    if (out_.event != TickEvent::first) out_.event = TickEvent::switched;
  }

  std::uint32_t nearest_patch() const {
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < x_.curve.patch_count(); ++i) {
      const CurvePatch& p = x_.curve.patch(i);
      if (distance_bound(x_, p) >= least) continue;
      for (const Vec2& at : {p.first, x_.curve.bezier(i, 0.5), p.last}) {
        const double distance = glm::length(x_.centre - at);
        if (distance < least) least = distance, nearest = i;
      }
    }
    return nearest;
  }

  /// The nearest stable contact nearer than `below`, on patches other than `besides`.
  bool search(double below, std::uint32_t besides, PlanarContact& best) {
    bool found = false;
    for (std::uint32_t i = 0; i < x_.curve.patch_count(); ++i) {
      if (i == besides || distance_bound(x_, x_.curve.patch(i)) >= below) continue;
      found = search_patch(i, below, best) || found;
    }
    return found;
  }

  bool search_patch(std::uint32_t i, double& below, PlanarContact& best) {
    const CurvePatch& p = x_.curve.patch(i);
    bool found = false;
    const auto consider = [&](const PlanarContact& contact) {
      if (!contact.converged() || contact.stability <= 0.0 || std::abs(contact.height_m) >= below) return;
      best = contact;
      below = std::abs(contact.height_m);
      found = true;
    };
    PlanarContact corner;
    if (p.joint_after != CurveJoint::smooth && end_contact(x_, i, true, corner)) consider(corner);
    if (p.joint_before == CurveJoint::end && end_contact(x_, i, false, corner)) consider(corner);
    for_brackets(i, [&](double low, double high) { consider(solve_between(i, low, high)); });
    return found;
  }

  /// Parts of the patch where the contact passes from ahead of the line's place to behind it: stable contacts.
  template <class Bracket>
  void for_brackets(std::uint32_t i, Bracket bracket) {
    const CurvePatch& p = x_.curve.patch(i);
    const double first = along_first(x_, p), last = along_last(x_, p);
    if (first >= 0.0 && last <= 0.0) return bracket(0.0, 1.0);
    // Both ends point the same way: none, or a stable and an unstable one, which takes ground concave towards the
    // finger.
    const bool concave = x_.curve.side() * cross(p.vertex - p.first, p.last - p.vertex) > 0.0;
    const bool ahead = glm::dot(x_.centre - p.vertex, x_.curve.normal_of(p.last - p.first)) > 0.0;
    if (p.straight || concave != ahead || (first < 0.0 && last > 0.0)) return;
    double before = residual(i, 0.0);
    for (int k = 1; k <= kParts; ++k) {
      const double t = static_cast<double>(k) / kParts, now = residual(i, t);
      if (before > 0.0 && now <= 0.0) bracket(t - 1.0 / kParts, t);
      before = now;
    }
  }

  double residual(std::uint32_t i, double t) {
    const LineSample s = x_.curve.sample(i, x_.settings.local_centre, t);
    ++out_.evaluations;
    const Vec2 contact = s.foot + glm::dot(x_.centre - s.foot, s.direction) * s.direction;
    return glm::dot(contact - s.place, s.direction);
  }

  /// Halves the part until Newton takes it from there.
  PlanarContact solve_between(std::uint32_t i, double low, double high) {
    PlanarContext quiet = x_;
    quiet.trace = nullptr;
    PlanarContact contact;
    for (int halvings = 0; halvings < 48; ++halvings) {
      const double middle = 0.5 * (low + high);
      contact = follow(quiet, {Feature::face, i, middle, {}, {}}, false, 6);
      out_.evaluations += contact.evaluations;
      const bool inside = contact.place.patch == i && contact.place.feature == Feature::face &&
                          contact.place.t >= low && contact.place.t <= high;
      if (contact.converged() && (inside || contact.patch_changes > 0)) return contact;
      (residual(i, middle) > 0.0 ? low : high) = middle;
    }
    return contact;
  }

  PlanarContext& x_;
  PlanarTrack out_;
};

}  // namespace

PlanarTrack track_planar(PlanarContext context, const PlanarPlace& kept) { return Tracker(context).run(kept); }

}  // namespace tangent
