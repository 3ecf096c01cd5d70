#include "core/tick/walls.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/hollow.h"
#include "core/contact/follow/iterate.h"
#include "core/shading/way_out.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <utility>

namespace tangent {
namespace {

/// A wall that ends in an inner edge may push on a ball that has come no deeper than half its radius from another one's
/// plane: with k the cosine between their normals it does where the height is below k / (1 + k) radii.
constexpr double kDeepOfRadius = 0.5;

SurfacePlace own_place(SurfacePlace place) {
  if (is_wall(place)) place.side = 0;
  return place;
}

class WallSearch {
 public:
  WallSearch(ContactContext& context, DecidedContact& decided, TouchedContacts& touched)
      : decided_(decided),
        touched_(touched),
        settings_(robust(context.settings)),
        led_out_(context.pose),
        finger_at_(context.pose),
        context_{context.cache, settings_, context.finger, led_out_, context.origin} {}

  /// The place that is touched from there, found from `start`, unless it is among them. Of one that is `known` to have
  /// been touched the finger may have come behind.
  bool add_from(const SurfacePlace& start, bool known) {
    if (touched_.full()) return false;
    lead_out();
    IterationResult r;
    iterate(context_, own_place(start), kSeedBudget, r);
    decided_.evaluations += r.evaluations;
    if (!r.converged() || r.plane.feature != Feature::face || !(r.contact.penetration_m > settings_.tolerance_m))
      return false;
    if (!known && !pushes_with_others(r.contact)) return false;
    const PlaneContact here = contact_on_plane(context_.finger, finger_at_, r.plane.point, r.plane.normal);
    if (!pushes(r.plane, here)) return false;
    r.plane.side = kWall;
    touched_.contacts[touched_.count++] = {r.plane, here};
    is_led_out_ = false;
    return true;
  }

  /// A place that was tracked; of a hollow crease both sides.
  void add_known(const SurfacePlace& place) {
    const ContactMesh& mesh = context_.cache.mesh();
    if (place.feature != Feature::edge || !is_hollow(mesh, place)) {
      add_from(place, true);
      return;
    }
    for (const SurfacePlace& side : sides_of(mesh, place)) add_from(side, true);
  }

  /// That of the triangle that a ball is deepest in there.
  bool add_nearest(const NearestTriangles& nearest) {
    const TrackedPlane& tracked = decided_.contact.plane;
    const double bulge = patch_bulge(context_.cache.patch(tracked.triangle, settings_.normal_form));
    const double within = round_radius_m(context_.finger) - settings_.tolerance_m - bulge;
    lead_out();
    const NearestHit hit = within > 0.0 ? nearest.nearest(led_out_.position, within) : NearestHit{};
    return hit && add_from(place_on_face(hit.triangle, hit.u, std::min(hit.v, 1.0 - hit.u)), false);
  }

 private:
  static SolverSettings robust(SolverSettings settings) {
    settings.method = Method::robust;
    return settings;
  }

  bool pushes(const TrackedPlane& plane, const PlaneContact& contact) const {
    const IterationResult& tracked = decided_.contact;
    return pushes_beside(touched_plane(tracked.plane, tracked.contact), touched_plane(plane, contact), true,
                         settings_.tolerance_m);
  }

  /// Out of all that is known.
  void lead_out() {
    if (std::exchange(is_led_out_, true)) return;
    const IterationResult& tracked = decided_.contact;
    PushingPlanes planes;
    planes.add({tracked.plane.normal, tracked.contact.penetration_m, 1.0});
    for (const TouchedContact& c : touched_.all())
      if (pushes(c.plane, c.contact)) planes.add({c.plane.normal, c.contact.penetration_m, 1.0});
    led_out_.position = finger_at_.position + shortest_way_out(planes.all());
  }

  DecidedContact& decided_;
  TouchedContacts& touched_;
  SolverSettings settings_;
  FingerPose led_out_;
  const FingerPose finger_at_;
  ContactContext context_;
  bool is_led_out_ = false;
};

}  // namespace

bool can_lack_walls(const ContactMesh& mesh, const Finger& finger, const Vec3& centre, const TrackedPlane& tracked,
                    const TouchedPlaces& kept) {
  if (!mesh.has_concave_crease()) return false;
  if (!is_round(finger)) return true;
  const double radius = round_radius_m(finger);
  if (radius > 0.0 && glm::dot(centre - tracked.point, tracked.normal) < kDeepOfRadius * radius) return true;
  return std::any_of(kept.places.begin(), kept.places.begin() + kept.count, is_wall);
}

bool is_behind_in_inner_edge(const ContactContext& context, const IterationResult& tracked,
                             const TouchedContacts& touched) {
  if (pushes_with_others(tracked.contact) || !context.cache.mesh().has_concave_crease()) return false;
  const TouchedPlane first = touched_plane(tracked.plane, tracked.contact);
  return std::all_of(touched.all().begin(), touched.all().end(), [&](const TouchedContact& c) {
    return c.contact.penetration_m <= tracked.contact.penetration_m &&
           pushes_beside(first, touched_plane(c.plane, c.contact), true, context.settings.tolerance_m);
  });
}

void add_walls(ContactContext& context, const NearestTriangles& nearest, const TouchedPlaces& kept,
               const TrackedPlane& last, DecidedContact& decided, TouchedContacts& touched) {
  touched.with_walls = true;
  WallSearch search(context, decided, touched);
  const std::size_t own = touched.count;
  const std::span<const SurfacePlace> before(kept.places.data(), kept.count);
  const auto walls_before = static_cast<std::size_t>(std::count_if(before.begin(), before.end(), is_wall));
  if (decided.event != TickEvent::none && last.feature != Feature::none) search.add_known(last);
  const bool own_lost = own < before.size() - walls_before;
  for (const SurfacePlace& place : before)
    if (own_lost || is_wall(place)) search.add_from(place, true);
  if (is_round(context.finger)) {
    while (search.add_nearest(nearest)) {}
  }
  if (touched.count - own != walls_before) decided.places_changed = true;
}

double deepest_m(ContactContext& context, const TouchedPlaces& kept, int& evaluations) {
  double deepest = 0.0;
  for (const SurfacePlace& place : std::span(kept.places).first(kept.count)) {
    TrackedPlane at;
    at.move_to(place);
    SurfaceSample sample;
    sample_place(context, at, sample);
    ++evaluations;
    deepest = std::max(deepest, contact_on_plane(context.finger, context.pose, at.point, at.normal).penetration_m);
  }
  return deepest;
}

bool go_on_with_wall(ContactContext& context, const TouchedPlaces& kept, DecidedContact& decided) {
  ContactContext quiet = context;
  quiet.trace = nullptr;
  const IterationResult lost = decided.contact;
  bool found = false;
  for (const SurfacePlace& place : std::span(kept.places).first(kept.count)) {
    if (!is_wall(place)) continue;
    IterationResult r;
    iterate(quiet, own_place(place), kTrackBudget, r);
    decided.evaluations += r.evaluations;
    if (!r.converged() || (found && r.contact.penetration_m <= decided.contact.contact.penetration_m)) continue;
    decided.contact = r;
    found = true;
  }
  if (!found || !(decided.contact.contact.penetration_m > 0.0)) {
    decided.contact = lost;
    return false;
  }
  decided.event = TickEvent::switched;
  return true;
}

}  // namespace tangent
