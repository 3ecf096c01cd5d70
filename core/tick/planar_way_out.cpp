#include "core/tick/planar_way_out.h"

#include "core/contact/decide/decide.h"
#include "core/planar/search.h"
#include "core/tick/pushing_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tangent {
namespace {

/// Lines that following a place from the last tick may take, as the tracked one. Fewer: the other side of a sharp notch
/// may get lost where the circle lies behind it, led out of the one.
constexpr int kFollowLines = 12;

RenderPlane plane_at(const PlanarContext& x, const Vec2& point, const Vec2& normal) {
  return {lifted(normal), x.radius_m - glm::dot(x.centre - point, normal), 1.0};
}

SurfacePlace kept_place(const PlanarPlace& place) {
  return {place.feature, 0, place.patch, place.t, std::atan2(place.normal.y, place.normal.x)};
}

/// What pushed at the last tick: the tracked place first, where it did.
struct LastPlaces {
  std::size_t count = 0;
  std::array<PlanarPlace, kMostTouched + 1> places;

  void add(const PlanarPlace& place) { places[count++] = place; }
  std::span<const PlanarPlace> all() const { return {places.data(), count}; }
};

LastPlaces last_places(const PlanarContext& x, const TickState& before) {
  LastPlaces last;
  const auto exists = [&](const SurfacePlace& place) {
    return place.feature != Feature::none && place.triangle < x.curve.patch_count();
  };
  const TrackedPlane& plane = before.plane;
  if (exists(plane) && before.has_converged && !before.unentered)
    last.add(
        {plane.feature, plane.triangle, plane.u, {plane.point.x, plane.point.y}, {plane.normal.x, plane.normal.y}});
  for (const SurfacePlace& place : std::span(before.touched.places).first(before.touched.count)) {
    if (!exists(place)) continue;
    const Vec2 point = place.feature == Feature::vertex
                           ? x.curve.vertex(place.triangle)
                           : x.curve.sample(place.triangle, x.settings.local_centre, place.u).place;
    last.add({place.feature, place.triangle, place.u, point, {std::cos(place.v), std::sin(place.v)}});
  }
  return last;
}

/// How deep the circle, led out by `way`, still is in a plane, m.
double left_m(const RenderPlane& plane, const Vec3& way) { return plane.penetration_m - glm::dot(plane.normal, way); }

/// Whether one of the planes says of the circle, led out by `way`, what this one says: in a slot narrower than the
/// circle that is in both its sides wherever it is.
bool is_known(const RenderPlane& plane, const PushingPlanes& planes, const Vec3& way, double tolerance_m) {
  return std::any_of(planes.all().begin(), planes.all().end(), [&](const RenderPlane& known) {
    return glm::dot(known.normal, plane.normal) > kJumpCosine && left_m(plane, way) - left_m(known, way) < tolerance_m;
  });
}

/// Leads the circle out of the tracked place and of all else that it is in from there.
class LeadingOut {
 public:
  LeadingOut(const PlanarContext& context, const PlanarTrack& track)
      : x_(context),
        track_(track),
        settings_(robust(context.settings)),
        led_out_{context.curve, settings_, context.centre, context.radius_m} {
    if (!track.unentered) planes_.add({lifted(track.contact.place.normal), x_.radius_m - track.contact.height_m, 1.0});
  }

  /// The places that pushed at the last tick and still do, followed to where those led the circle out.
  void follow_last(const LastPlaces& last, const PushingPlanes& last_planes) {
    lead(last_planes.way_out());
    for (const PlanarPlace& place : last.all()) {
      const PlanarContact now = follow(led_out_, place, true, kFollowLines);
      work_.evaluations += now.evaluations;
      if (now.converged() && now.stability > 0.0 && now.height_m >= 0.0) offer(now.place);
    }
  }

  /// More of them. `known_m`: how deep the circle is in what is known.
  void look_for_more(double known_m) {
    const FingerStep step{x_.moved_m, settings_.switch_hysteresis_m};
    PlanarRival rival{x_.radius_m - settings_.tolerance_m, {}, true};
    PlanarContact found;
    for (;;) {
      lead(planes_.way_out());
      // Led out of the tracked place alone, the circle touches it where it was.
      rival.besides = track_.unentered || count_ == 0 ? track_.contact.place : PlanarPlace{};
      if (count_ == kMostTouched || !nearest_contact(led_out_, rival, found, work_)) break;
      const double depth = plane_at(x_, found.place.point, found.place.normal).penetration_m;
      if (track_.event != TickEvent::first && !was_entered(step, depth, known_m)) break;
      if (!offer(found.place)) break;
    }
  }

  const PushingPlanes& planes() const { return planes_; }
  const Vec3& way() const { return way_; }
  int evaluations() const { return work_.evaluations; }
  /// Those that the circle, led out, touches.
  TouchedPlaces touched() const {
    TouchedPlaces kept;
    for (const PlanarPlace& place : std::span(places_).first(count_)) {
      const RenderPlane plane = plane_at(x_, place.point, place.normal);
      if (left_m(plane, way_) > -settings_.tolerance_m) kept.places[kept.count++] = kept_place(place);
    }
    return kept;
  }

 private:
  static SolverSettings robust(SolverSettings settings) {
    settings.method = Method::robust;
    return settings;
  }

  void lead(const Vec3& way) {
    way_ = way;
    led_out_.centre = x_.centre + Vec2(way.x, way.y);
  }

  /// False: it says nothing new.
  bool offer(const PlanarPlace& place) {
    const RenderPlane plane = plane_at(x_, place.point, place.normal);
    if (count_ == kMostTouched || is_known(plane, planes_, way_, settings_.tolerance_m)) return false;
    planes_.add(plane);
    places_[count_++] = place;
    return true;
  }

  const PlanarContext& x_;
  const PlanarTrack& track_;
  SolverSettings settings_;
  PlanarContext led_out_;
  Vec3 way_{0.0};
  PushingPlanes planes_;
  std::size_t count_ = 0;
  std::array<PlanarPlace, kMostTouched> places_;
  PlanarWork work_;
};

}  // namespace

PlanarWayOut find_planar_way_out(const PlanarContext& x, const PlanarTrack& track, const TickState& before) {
  const LastPlaces last = last_places(x, before);
  PushingPlanes last_planes;
  for (const PlanarPlace& place : last.all()) last_planes.add(plane_at(x, place.point, place.normal));

  LeadingOut leading(x, track);
  const double known_m = std::max(last_planes.deepest_m(), leading.planes().deepest_m());
  // A circle that is out of what is nearest is out of all that it does not touch where it is.
  if (before.touched.count > 0 && leading.planes().deepest_m() > 0.0) leading.follow_last(last, last_planes);
  leading.look_for_more(known_m);

  PlanarWayOut out;
  out.places = leading.touched();
  if (out.places.count > 0) out.way_out_m = leading.way();
  if (out.places.count > 0 || before.touched.count > 0)
    out.leapt = has_leapt(last_planes.way_out(), leading.way(), x.moved_m, x.settings.switch_hysteresis_m);
  out.evaluations = leading.evaluations();
  return out;
}

}  // namespace tangent
