// The places that the finger touches besides the tracked one: where the force comes from all of them, they are followed
// like it (preset key force.contacts).
#pragma once

#include "core/base/tolerances.h"
#include "core/contact/tracked_plane.h"
#include "core/finger/plane_contact.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace tangent {

/// With the tracked one four: three walls of a corner and one to spare. Of more the deepest count.
inline constexpr std::size_t kMostTouched = 3;

/// What one tick hands to the next of them.
struct TouchedPlaces {
  std::uint32_t count = 0;
  std::array<SurfacePlace, kMostTouched> places;
};

/// Places that have met; both walls of an inner edge have not where they meet, they still face apart.
inline bool are_one_place(const TrackedPlane& a, const TrackedPlane& b, double same_m) {
  const Vec3 apart = a.point - b.point;
  return glm::dot(apart, apart) <= same_m * same_m && glm::dot(a.normal, b.normal) > kJumpCosine;
}

struct TouchedContact {
  TrackedPlane plane;
  PlaneContact contact;
};

/// Those of one tick, in no order.
struct TouchedContacts {
  std::size_t count = 0;
  bool with_walls = false;  ///< the finger is so deep in the tracked place that walls were looked for (tick/walls.h)
  std::array<TouchedContact, kMostTouched> contacts;

  bool full() const { return count == kMostTouched; }
  std::span<const TouchedContact> all() const { return {contacts.data(), count}; }
  const TouchedContact& shallowest() const {
    const TouchedContact* least = &contacts[0];
    for (const TouchedContact& c : all())
      if (c.contact.penetration_m < least->contact.penetration_m) least = &c;
    return *least;
  }
  /// In place of the shallowest where there is no room, or not at all. `same_m`: nearer than that it is a known place.
  void add(const TouchedContact& contact, double same_m) {
    for (const TouchedContact& c : all())
      if (are_one_place(c.plane, contact.plane, same_m)) return;
    if (!full()) {
      contacts[count++] = contact;
      return;
    }
    auto& least = contacts[static_cast<std::size_t>(&shallowest() - contacts.data())];
    if (contact.contact.penetration_m > least.contact.penetration_m) least = contact;
  }
  TouchedPlaces places() const {
    TouchedPlaces kept;
    for (const TouchedContact& c : all()) kept.places[kept.count++] = c.plane;
    return kept;
  }
};

/// A contact on the outside pushes together with others. One that the finger's centre is behind of is the way out by
/// itself: of two sides of a wall, or of a sharp edge seen from inside, the finger need not leave both.
inline bool pushes_with_others(const PlaneContact& contact) { return contact.height_m >= 0.0; }

/// Whether two places face apart as both sides of a plate do, or of a wedge of up to 60 degrees.
inline bool faces_away(const TrackedPlane& a, const TrackedPlane& b) { return glm::dot(a.normal, b.normal) < -0.5; }

/// Whether a place is the far side of what the finger is in, a plate's or a fin's other face: it faces away from the
/// tracked place, and the finger's centre has come behind either of them. What the finger has left on that side is
/// none.
inline bool is_far_side(const TouchedContact& place, const TouchedContact& tracked) {
  const bool behind =
      place.contact.height_m < 0.0 || (tracked.contact.height_m < 0.0 && place.contact.penetration_m > 0.0);
  return behind && tracked.contact.penetration_m > 0.0 && faces_away(place.plane, tracked.plane);
}

/// Which places a finger whose contact was lost can have come into from outside.
struct EnteredPlaces {
  double deepest_m = std::numeric_limits<double>::infinity();  ///< none that is deeper
  double behind_m = std::numeric_limits<double>::infinity();   ///< nor one that the centre is further behind
  std::optional<TouchedContact> last;                          ///< what was tracked: nor what is its far side
  /// It was so deep in something that it can't have left it all since: a place that it doesn't touch is no way out.
  bool pressed = false;
  bool inside = false;  ///< pressed into a closed body, and not far from there
  /// Inside: so far what was tracked may slide along the surface when its place ends there.
  double most_slide_m = 0.0;

  bool hold(const TrackedPlane& plane, const PlaneContact& contact) const {
    return !(contact.penetration_m > deepest_m + slide_m(plane)) && !(contact.height_m < -behind_m) &&
           !(last && is_far_side({plane, contact}, *last));
  }
  /// Whether a lost contact may go on there, rather than at others.
  bool go_on_at(const TrackedPlane& plane, const PlaneContact& contact) const {
    return hold(plane, contact) && (!pressed || contact.penetration_m > 0.0);
  }
  /// By how much deeper than others a place may be, m: inside a body, where a contact ends, a god-object slides on
  /// along the surface to where it rests again, and by a ball's depth no more than its way there is explained. 0 where
  /// that is too far, or faces elsewhere.
  double slide_m(const TrackedPlane& plane) const {
    if (!inside || !last || !(glm::dot(plane.normal, last->plane.normal) > 0.0)) return 0.0;
    const double way = glm::distance(plane.point, last->plane.point);
    return way <= most_slide_m ? way : 0.0;
  }
};

}  // namespace tangent
