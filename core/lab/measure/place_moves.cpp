#include "core/lab/measure/place_moves.h"

#include "core/contact/follow/step_rule.h"
#include "core/finger/plane_contact.h"
#include "core/lab/gains/paper_contraction.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tangent {

namespace {

/// Whether the finger can rest there, that is, the contact is stable.
bool stable_contact(const Finger& finger, const FingerPose& pose, const SurfaceSample& s) {
  const Stability m =
      face_stability(s, contact_jacobian(finger, pose, s, contact_on_plane(finger, pose, s.point, s.normal)));
  return m.det > 0.0 && m.trace > 0.0;
}

Vec3 tangent_of(const SurfaceSample& s) {
  const Vec3 along = s.point_u - glm::dot(s.point_u, s.normal) * s.normal;
  const double length = std::sqrt(glm::dot(along, along));
  return length > 0.0 ? along / length : Vec3(0.0);
}

}  // namespace

std::optional<RestingFinger> rest_at(const PnPatch& patch, std::uint32_t triangle, double u, double v,
                                     const Finger& finger, double press_m) {
  RestingFinger out;
  out.place = evaluate(patch, u, v);
  out.pose = pose_touching(finger, out.place, press_m);
  if (!is_finite(out.pose.position) || !stable_contact(finger, out.pose, out.place)) return std::nullopt;
  out.kept.plane = {Feature::face, 0, triangle, u, v, out.place.point, out.place.normal};
  out.kept.last_converged = {out.kept.plane.point, out.kept.plane.normal};
  out.kept.has_converged = 1;
  out.kept.clearance = Clearance::unlimited();
  return out;
}

Vec3 move_direction(const SurfaceSample& place, const MoveOptions& options, unsigned i) {
  if (i >= options.directions) return -place.normal;
  const Vec3 across = tangent_of(place), along = glm::cross(place.normal, across);
  const double angle = 2.0 * std::numbers::pi * i / options.directions;
  return std::cos(angle) * across + std::sin(angle) * along;
}

TickInput moved(const ContactMesh& mesh, const RestingFinger& resting, const MoveOptions& options, unsigned i) {
  TickInput input;
  input.finger = resting.pose;
  input.finger.position += mesh.origin() + options.move_m * move_direction(resting.place, options, i);
  return input;
}

std::vector<PlaceMove> solve_moves(Stepper& stepper, const Preset& preset, std::uint32_t triangle, double u, double v,
                                   const MoveOptions& options) {
  const ContactMesh& mesh = stepper.scene().mesh();
  const PnPatch patch = make_patch(mesh, triangle, preset.solver.normal_form);
  const auto resting = rest_at(patch, triangle, u, v, preset.finger, options.press_m);
  std::vector<PlaceMove> moves;
  for (unsigned i = 0; resting && i <= options.directions; ++i) {
    TickState state = resting->kept;
    PlaceMove move{move_direction(resting->place, options, i), moved(mesh, *resting, options, i), resting->kept, {}};
    move.output = stepper.step(preset, move.input, state);
    moves.push_back(move);
  }
  return moves;
}

std::size_t worst_move(const std::vector<PlaceMove>& moves) {
  const auto rank = [](const PlaceMove& m) { return std::pair(m.failed(), m.output.iterations); };
  const auto worst = std::max_element(moves.begin(), moves.end(),
                                      [&rank](const PlaceMove& a, const PlaceMove& b) { return rank(a) < rank(b); });
  return static_cast<std::size_t>(worst - moves.begin());
}

}  // namespace tangent
