#include "core/contact/prove/clearance_check.h"

#include "core/contact/prove/contact_hierarchy.h"

#include <algorithm>

namespace tangent {

double turned_m(const Finger& finger, const Quat& from, const Quat& to) {
  if (from == to) return 0.0;
  return finger.reach_m() * 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(from, to))));
}

// Distances are convex along a straight way, and so are angles of turning as small as margins allow.
bool stayed_within(double then_m, double before_m, double now_m, double here_m, double moved_m) {
  constexpr double kRounded = 1e-6;  // far more than a margin kept as a float is
  if (here_m >= moved_m) return true;
  const double last = here_m / moved_m;  // part of the way
  return last * before_m + (1.0 - last) * now_m <= then_m - kRounded * now_m;
}

// Shortened by far more than floats are rounded by: at a margin itself a contact may be there.
void set_free(Clearance& known) {
  double least = known.margin_m;
  for (const WatchedTriangle& watched : known.on_watch()) least = std::min(least, double{watched.margin_m});
  known.free_m = (1.0 - 1e-6) * least;
}

// Less by the way here, since a finger may go back by known.centre.
void forget_surroundings(Clearance& known, double gone, double within_m) {
  const double margin = std::max(0.0, within_m - gone);
  known.margin_m = std::min(known.margin_m, margin);
  known.free_m = std::min(known.free_m, margin);
}

/// What a search looks at where such a place is.
static SearchPart part_of(const ContactMesh& mesh, const SurfacePlace& place) {
  if (place.feature == Feature::edge) return side_part(place.side);
  if (place.feature == Feature::vertex) return corner_part(place.side);
  return mesh.flat_regions().of(place.triangle) == kNone ? SearchPart::face : SearchPart::region;
}

bool watch_again(Clearance& known, const ContactMesh& mesh, const SurfacePlace& place) {
  if (known.under_way || known.margin_m < 0.0 || known.watched_count == Clearance::kWatched) return false;
  known.watched[known.watched_count++] = {place.triangle & 0xFFFFFFFu,
                                          static_cast<std::uint32_t>(part_of(mesh, place)) & 7u, 1, 0.0f};
  known.free_m = -1.0;
  return true;
}

// By the triangle inequality, which angles of turning obey, too.
void recentre(Clearance& known, const FingerPose& pose, double gone) {
  if (known.ahead_centre == known.centre) {
    known.ahead_centre = pose.position;
    known.ahead_m -= gone;
    known.ahead_height_m -= gone;
  } else {  // the turning is counted from here on
    const Vec3 d = pose.position - known.centre;
    const double turned = gone - std::sqrt(glm::dot(d, d));
    known.ahead_m -= turned;
    known.ahead_height_m -= turned;
  }
  known.centre = pose.position;
  known.orientation = pose.orientation;
  known.margin_m -= gone;
  for (WatchedTriangle& watched : known.on_watch()) watched.margin_m -= static_cast<float>(gone);
  set_free(known);
}

}  // namespace tangent
