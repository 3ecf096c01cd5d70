#include "core/contact/follow/edge.h"

#include "core/contact/follow/walk.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

const EdgeFan& fan_at(ContactContext& context, const SurfacePlace& at) {
  return context.cache.fan(at.triangle, at.side, edge_fraction(at.side, at.u, at.v), context.settings.normal_form);
}

/// A move along an edge, on to the vertex where it starts at an end. A step past an end is carried on along the crease,
/// once in a run: where the contact wants to rest on the vertex, the next step leads back and stops there.
SurfacePlace move_along_edge(const ContactMesh& mesh, const SurfacePlace& at, double f, double df, const EdgeFan& fan,
                             RunMemory& memory) {
  const bool forwards = df > 0.0;
  if (forwards ? f >= 1.0 : df < 0.0 && f <= 0.0) {
    SurfacePlace p = at;
    p.feature = Feature::vertex;
    p.side = static_cast<std::uint8_t>(forwards ? (at.side + 1) % 3 : at.side);
    return p;
  }
  const double to = f + df, beyond = forwards ? to - 1.0 : -to;
  if (beyond > 0.0 && !memory.carried) {
    memory.carried = true;
    if (const auto next = walk_past_end(mesh, at.triangle, at.side, forwards, beyond * glm::length(fan.point_f)))
      return *next;
  }
  return place_on_edge(at.triangle, at.side, std::clamp(to, 0.0, 1.0));
}

/// Where a contact on an edge wants to go: along it by Newton's step or, where that is not to be trusted or for the
/// paper's method, by the travel; or off it, into the face on one side.
struct EdgeMove {
  ParameterStep step;      ///< da: along f, db: of the turn
  double df_travel = 0.0;  ///< f by the travel alone; 0 where the step is Newton's
  bool into_near = false, into_far = false;
};

EdgeMove edge_move(ContactContext& context, const EdgeFan& fan, const IterationResult& now,
                   const ContactJacobian& jacobian, bool has_far) {
  EdgeMove move;
  move.step = newton_step(now.sample, jacobian, now.contact);
  if (is_round(context.finger)) {
    const Vec3 d = context.pose.position - now.sample.point;
    move.step.da = fan.uniform ? uniform_step(fan, d) : round_edge_step(edge_bend(now.sample), now.contact.height_m, d);
  }
  const bool trusted = move.step.valid && now.stability.stable(), paper = context.settings.method == Method::paper;
  if (!trusted || paper) {
    const double speed2 = glm::dot(fan.point_f, fan.point_f);
    move.df_travel = speed2 > 0.0 ? glm::dot(now.contact.travel, fan.point_f) / speed2 : 0.0;
  }
  if (!trusted) move.step.da = move.df_travel, move.step.db = 0.0;
  move.step.valid = true;
  if (paper) {
    move.step.curvature_per_m = directional_curvature(now.sample, 1.0, 0.0);
    move.step.distance_m = paper_distance(context.settings, now.contact);
    move.step.gain = paper_gain(context.settings, move.step.curvature_per_m, move.step.distance_m);
    move.step.da = move.step.gain * move.df_travel;
  }
  // At an end of the fan the plane wants to turn on into the face.
  const bool at_near = now.plane.turn == kNearTurn, at_far = now.plane.turn == fan.far;
  if (!at_near && !at_far) return move;
  if (trusted && !paper) {
    move.into_near = at_near && move.step.db < 0.0;
    move.into_far = at_far && has_far && move.step.db > 0.0;
    return move;
  }
  const bool outside = !in_fan(fan, facing_turn(fan, context.finger, context.pose));
  move.into_near = at_near && outside;
  move.into_far = at_far && has_far && outside;
  return move;
}

/// Neither the place nor the plane can change any more.
bool rests_on_edge(ContactContext& context, const EdgeFan& fan, const TrackedPlane& at, const SurfacePlace& next) {
  if (next.feature != Feature::edge || next.triangle != at.triangle || next.u != at.u || next.v != at.v) return false;
  const Vec2 wanted = facing_turn(fan, context.finger, context.pose);
  return in_fan(fan, wanted) && glm::distance(wanted, at.turn) < 1e-12;
}

}  // namespace

void sample_edge(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample) {
  const EdgeFan& fan = fan_at(context, plane);
  plane.turn = clamp_turn(fan, facing_turn(fan, context.finger, context.pose));
  edge_sample(fan, plane.turn, sample);
}

void sample_kept_edge(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample) {
  const EdgeFan& fan = fan_at(context, plane);
  edge_sample(fan, plane.turn, sample);
  if (glm::dot(sample.normal, plane.normal) < 1.0 - 1e-14) {  // of another normal form, or given from outside
    plane.turn = clamp_turn(fan, turn_of(fan, plane.normal));
    edge_sample(fan, plane.turn, sample);
  }
  sample.normal = plane.normal;
}

Proposal next_from_edge(ContactContext& context, const TrackedPlane& at, RunMemory& memory, IterationResult& now) {
  Proposal next;
  const ContactMesh& mesh = context.cache.mesh();
  const double f = edge_fraction(at.side, at.u, at.v);
  const EdgeFan& fan = context.cache.fan(at.triangle, at.side, f, context.settings.normal_form);
  const ContactJacobian jacobian = contact_jacobian(context.finger, context.pose, now.sample, now.contact);
  now.stability = is_round(context.finger) ? edge_bend(now.sample).at_height(now.contact.height_m)
                                           : edge_stability(now.sample, jacobian);
  const bool exact = now.contact.error_m < context.settings.tolerance_m;
  if (exact && now.stability.stable()) {
    next.stop = StopReason::converged;
    return next;
  }
  const EdgeLink other = mesh.across(at.triangle, at.side);
  const EdgeMove move = edge_move(context, fan, now, jacobian, other.triangle != kNone);
  next.step = move.step;
  // The paper's contact slides along the edge first: what is left across it then says which face, without going to and
  // fro.
  const bool slide = context.settings.method == Method::paper &&
                     std::abs(move.df_travel) * glm::length(fan.point_f) > 0.5 * now.contact.error_m;
  if (move.into_near && !slide) {
    next.place = place_on_face(at.triangle, at.u, at.v);
    return next;
  }
  if (move.into_far && !slide) {
    const Vec2 uv = edge_point_uv(other.edge, 1.0 - f);
    next.place = place_on_face(other.triangle, uv.x, uv.y);
    next.triangle_changes = 1;
    return next;
  }
  const bool leaves = move.into_near || move.into_far;
  next.place = move_along_edge(mesh, at, f, leaves ? move.step.da : std::clamp(move.step.da, -2.0, 2.0), fan, memory);
  if (!leaves && rests_on_edge(context, fan, at, next.place))
    next.stop = exact ? StopReason::unstable : StopReason::singular_patch;
  return next;
}

}  // namespace tangent
