#include "core/planar/track.h"

#include "core/base/tolerances.h"
#include "core/contact/decide/decide.h"
#include "core/planar/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

/// New lines a tick may spend on following and on one seed.
constexpr int kTrackLines = 12, kSeedLines = 24;
/// Places that are looked at between the kept contact and the new one where the normal has turned far, and the
/// stability below which the ground there has folded.
constexpr int kWayPlaces = 24;
constexpr double kFoldedStability = 0.1;

class Tracker {
 public:
  Tracker(PlanarContext& context, bool others_push) : x_(context), others_push_(others_push) {}

  PlanarTrack run(const PlanarKept& last) {
    const PlanarPlace& kept = last.place;
    out_.unentered = last.unentered;
    const bool robust = x_.settings.method == Method::robust;
    const int limit = x_.settings.max_iterations;
    if (kept.feature == Feature::none) {
      out_.event = TickEvent::first;
      find_again(limit);
    } else {
      follow_from(kept, true, robust ? std::min(limit, kTrackLines) : limit);
      if (!out_.converged()) {
        out_.event = TickEvent::reseed;
        found_again_ = true;
        find_again(limit);
      } else if (leapt(last)) {
        out_.event = TickEvent::branch;
      }
    }
    if (!out_.converged()) return out_;
    if (!(depth_m(out_.contact) > 0.0)) out_.unentered = false;  // left: from now on it counts
    hand_over();
    if (out_.event == TickEvent::first) out_.unentered = false;
    if (out_.event != TickEvent::first && out_.event != TickEvent::switched) look_from_outside(last.depth_m);
    return out_;
  }

 private:
  FingerStep finger_step() const { return {x_.moved_m, x_.settings.switch_hysteresis_m}; }
  double depth_m(const PlanarContact& contact) const { return x_.radius_m - contact.height_m; }

  TouchedContact touched_of(const PlanarContact& contact) const {
    TouchedContact touched;
    touched.plane.normal = lifted(contact.place.normal);
    touched.contact.height_m = contact.height_m;
    touched.contact.penetration_m = depth_m(contact);
    return touched;
  }

  void follow_from(const PlanarPlace& start, bool kept, int budget) { take(follow(x_, start, kept, budget)); }
  /// Whether the contact, found again or followed round a rim to the other side, has been entered.
  void look_from_outside(double before_m) {
    const bool behind = is_unentered(finger_step(), depth_m(out_.contact), before_m, !(before_m > 0.0));
    if (behind && !out_.unentered && out_.event == TickEvent::none) out_.event = TickEvent::branch;
    out_.unentered = behind || (out_.unentered && !found_again_ && !was_put_elsewhere(finger_step()));
  }

  void take(const PlanarContact& contact) {
    out_.evaluations += contact.evaluations;
    out_.patch_changes += contact.patch_changes;
    out_.contact = contact;
  }

  /// Whether the contact did not go on but fell to another place: the normal has turned far, and either the depth has
  /// changed by more than the finger's motion explains, as where it slides off an open end from behind, or the ground
  /// on the way there cannot hold a stable contact at this pose.
  bool leapt(const PlanarKept& last) const {
    const PlanarPlace &kept = last.place, &now = out_.contact.place;
    if (glm::dot(kept.normal, now.normal) >= kJumpCosine) return false;
    const double change_m = std::max(0.0, depth_m(out_.contact)) - std::max(0.0, last.depth_m);
    if (!last.unentered && std::abs(change_m) > 2.0 * x_.moved_m + x_.settings.switch_hysteresis_m) return true;
    const auto count = static_cast<double>(x_.curve.patch_count());
    const double from = kept.patch + kept.t;
    double way = now.patch + now.t - from;
    if (x_.curve.closed()) way = std::remainder(way, count);
    for (int k = 1; k < kWayPlaces; ++k) {
      double at = from + way * k / kWayPlaces;
      if (x_.curve.closed()) at -= count * std::floor(at / count);
      const auto patch = std::min(static_cast<std::uint32_t>(at), x_.curve.patch_count() - 1);
      if (stability_at(x_, patch, at - patch) < kFoldedStability) return true;
    }
    return false;
  }

  /// The contact that the nearest patch leads to; where that leads to none, the nearest of all.
  void find_again(int limit) {
    double distance = 0.0;
    const std::uint32_t nearest = nearest_patch(x_, distance);
    ++x_.seed;
    const double t = std::clamp(x_.curve.parameter(nearest, x_.settings.local_centre, x_.centre), 0.0, 1.0);
    const bool robust = x_.settings.method == Method::robust;
    follow_from({Feature::face, nearest, t, {}, {}}, false, robust ? kSeedLines : limit);
    if (!robust || out_.converged()) return;
    // The place of the curve that is nearest holds a contact, as a rule.
    PlanarContact best;
    if (look_for({distance + x_.settings.tolerance_m, {}}, best) ||
        look_for({std::numeric_limits<double>::infinity(), {}}, best))
      take_found(best);
  }

  bool look_for(const PlanarRival& rival, PlanarContact& best) {
    PlanarWork work;
    const bool found = nearest_contact(x_, rival, best, work);
    out_.evaluations += work.evaluations;
    return found;
  }

  void take_found(const PlanarContact& best) {
    out_.contact = best;
    ++x_.seed;
    // Solved on by itself, so that the trace ends on the contact.
    const PlanarContact again = follow(x_, best.place, true, x_.settings.max_iterations);
    if (again.converged()) out_.contact = again;
  }

  /// Whether a rival is touched as the tracked place is, so that both push. A finger whose centre is behind the one has
  /// left at the other if that is in front of it.
  bool pushes_beside_tracked(const PlanarContact& rival) const {
    return others_push_ && !out_.unentered && depth_m(out_.contact) > 0.0 &&
           !(out_.contact.height_m < 0.0 && rival.height_m >= 0.0);
  }

  void hand_over() {
    const double mine = std::abs(out_.contact.height_m);
    PlanarContact rival;
    if (!look_for({mine - x_.settings.switch_hysteresis_m, out_.contact.place}, rival)) return;
    // A first contact and one that was found again start at the deepest place.
    const bool anew = out_.event == TickEvent::first || found_again_;
    if (!anew && pushes_beside_tracked(rival) &&
        !(std::abs(rival.height_m) < mine - kTremor * x_.settings.switch_hysteresis_m))
      return;
    const double tracked = out_.unentered ? 0.0 : depth_m(out_.contact);
    if (!anew && !was_entered(finger_step(), depth_m(rival), tracked)) return;
    if (!anew && tracked > 0.0 && !was_put_elsewhere(finger_step()) &&
        is_far_side(touched_of(rival), touched_of(out_.contact)))
      return;
    take_found(rival);
    out_.unentered = false;
    if (out_.event != TickEvent::first) out_.event = TickEvent::switched;
  }

  PlanarContext& x_;
  PlanarTrack out_;
  bool others_push_;
  bool found_again_ = false;
};

}  // namespace

PlanarTrack track_planar(PlanarContext context, const PlanarKept& kept, bool others_push) {
  return Tracker(context, others_push).run(kept);
}

}  // namespace tangent
