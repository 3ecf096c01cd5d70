// `run` is the loop; faces, edges and vertices each have their own way of going on.
#include "core/contact/follow/iterate.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/follow/vertex.h"
#include "core/contact/follow/walk.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Where an iteration goes next, and what the trace shows of the step.
struct Proposal {
  SurfacePlace place;
  ParameterStep step;
  int triangle_changes = 0;
  StopReason stop = StopReason::going_on;  ///< converged, or why there is no next place
};

/// What the planes of one run so far leave for the next.
struct RunMemory {
  double least = 1e300;  ///< error; when it stops falling, the iteration goes round in circles
  int least_at = 0;
  bool carried = false;                                        ///< a step was carried past the end of an edge
  std::uint32_t no_exit_triangle = kNone, no_exit_corner = 0;  ///< a vertex that nothing draws this finger away from
  Vec3 last_travel{0.0}, last_point{0.0};

  void add_error(double error, int evaluation) {
    if (error >= 0.99 * least) return;
    least = error;
    least_at = evaluation;
  }

  /// Along a long finger the contact runs from one end to the other while the normal turns by a little, so that
  /// Newton's steps can overshoot to and fro for ever. After one that turned the travel round without halving it, the
  /// next goes back half way at most.
  void rein_in(const IterationResult& now, ParameterStep& step) {
    const Vec3 travel = now.contact.travel, moved = now.sample.point - last_point;
    if (glm::dot(travel, last_travel) < 0.0 && glm::dot(travel, travel) > 0.25 * glm::dot(last_travel, last_travel)) {
      const Vec3 ds = step.da * now.sample.point_u + step.db * now.sample.point_v;
      const double length2 = glm::dot(ds, ds), limit2 = 0.25 * glm::dot(moved, moved);
      if (length2 > limit2) {
        const double shorter = std::sqrt(limit2 / length2);
        step.da *= shorter;
        step.db *= shorter;
      }
    }
    last_travel = travel;
    last_point = now.sample.point;
  }
};

ParameterStep face_step(IterationContext& context, const IterationResult& now, const ContactJacobian& jacobian) {
  switch (context.settings.method) {
    case Method::newton:
      return newton_step(now.sample, jacobian, now.contact);
    case Method::robust:
      return robust_face_step(now.sample, jacobian, now.stability, now.contact, now.bend.area_m2);
    default:
      return paper_face_step(context.cache.mesh(), context.settings, now.plane.triangle, now.sample, now.contact);
  }
}

/// Walks from a face; false if the walk got lost.
bool move_on_face(const IterationContext& context, const ParameterStep& step, IterationResult& now) {
  if (stays_inside(now.plane.u, now.plane.v, step.da, step.db)) {
    now.plane.u += step.da;
    now.plane.v += step.db;
    return true;
  }
  const bool tracking = context.seed == 0 && context.settings.method == Method::robust;
  const WalkResult walk = walk_face(context.cache.mesh(), now.plane.triangle, now.plane.u, now.plane.v, step.da,
                                    step.db, tracking ? kMostTrackedCrossings : kMostCrossings);
  if (walk.lost) return false;  // the plane stays with its sample
  now.plane.move_to(walk.place);
  now.triangle_changes += walk.triangle_changes;
  return true;
}

double step_length(const ContactMesh& mesh, std::uint32_t t, const ParameterStep& step) {
  const Vec3 s =
      step.da * (mesh.position(t, 1) - mesh.position(t, 0)) + step.db * (mesh.position(t, 2) - mesh.position(t, 0));
  return std::sqrt(glm::dot(s, s));
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

EdgeMove edge_move(IterationContext& context, const EdgeFan& fan, const IterationResult& now,
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
bool rests_on_edge(IterationContext& context, const EdgeFan& fan, const TrackedPlane& at, const SurfacePlace& next) {
  if (next.feature != Feature::edge || next.triangle != at.triangle || next.u != at.u || next.v != at.v) return false;
  const Vec2 wanted = facing_turn(fan, context.finger, context.pose);
  return in_fan(fan, wanted) && glm::distance(wanted, at.turn) < 1e-12;
}

Proposal next_from_edge(IterationContext& context, const TrackedPlane& at, RunMemory& memory, IterationResult& now) {
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

Proposal next_from_vertex(IterationContext& context, const SurfacePlace& at, RunMemory& memory, IterationResult& now,
                          bool kept) {
  Proposal next;
  now.stability = now.contact.height_m > 0.0 ? Stability{1.0, 2.0} : Stability{0.0, 0.0};
  VertexExit exit;
  if (memory.no_exit_triangle != at.triangle || memory.no_exit_corner != at.side) exit = vertex_exit(context, at);
  next.step.valid = true;
  if (!exit.place) {
    memory.no_exit_triangle = at.triangle;
    memory.no_exit_corner = at.side;
    if (now.contact.error_m < context.settings.tolerance_m) {
      next.stop = now.stability.stable() ? StopReason::converged : StopReason::unstable;
    } else if (kept) {
      next.place = at;  // turn the kept plane to face the finger
    } else {
      next.stop = StopReason::singular_patch;
    }
    return next;
  }
  next.place = *exit.place;
  next.triangle_changes = exit.place->triangle != at.triangle ? 1 : 0;
  return next;
}

void record(IterationContext& context, const IterationResult& now, const ParameterStep& step, double step_m,
            StopReason stop) {
  IterationRecord r;
  r.feature = now.plane.feature;
  r.stop = stop;
  r.seed = context.seed;
  r.triangle = now.plane.triangle;
  r.u = now.plane.u;
  r.v = now.plane.v;
  r.point = context.origin + now.plane.point;
  r.normal = now.plane.normal;
  r.contact = r.point + now.contact.travel;
  r.travel = now.contact.travel;
  r.error_m = now.contact.error_m;
  r.gain = stop == StopReason::going_on ? step.gain : 0.0;
  r.curvature_per_m = step.curvature_per_m;
  if (r.curvature_per_m == 0.0) r.curvature_per_m = directional_curvature(now.sample, step.da, step.db);
  r.distance_m = paper_distance(context.settings, now.contact);
  r.step_m = step_m;
  r.det_m = now.stability.det;
  r.trace_m = now.stability.trace;
  context.trace->push(r);
}

}  // namespace

void sample_place(IterationContext& context, TrackedPlane& plane, SurfaceSample& sample) {
  const NormalForm form = context.settings.normal_form;
  if (plane.feature == Feature::face) {
    context.cache.sample(plane.triangle, form, plane.u, plane.v, sample);
  } else if (plane.feature == Feature::edge) {
    const EdgeFan& fan =
        context.cache.fan(plane.triangle, plane.side, edge_fraction(plane.side, plane.u, plane.v), form);
    plane.turn = clamp_turn(fan, facing_turn(fan, context.finger, context.pose));
    edge_sample(fan, plane.turn, sample);
  } else {
    sample = vertex_sample(context, plane);
  }
  plane.point = sample.point;
  plane.normal = sample.normal;
}

namespace {

/// Sample of the plane kept from the last tick: edges and vertices keep the normal they had.
SurfaceSample kept_place_sample(IterationContext& context, TrackedPlane& plane) {
  SurfaceSample s;
  if (plane.feature == Feature::face) {
    context.cache.sample(plane.triangle, context.settings.normal_form, plane.u, plane.v, s);
    return s;
  }
  if (plane.feature == Feature::vertex) return vertex_sample_at(context, plane, plane.normal);
  const EdgeFan& fan = context.cache.fan(plane.triangle, plane.side, edge_fraction(plane.side, plane.u, plane.v),
                                         context.settings.normal_form);
  edge_sample(fan, plane.turn, s);
  if (glm::dot(s.normal, plane.normal) < 1.0 - 1e-14) {  // of another normal form, or given from outside
    plane.turn = clamp_turn(fan, turn_of(fan, plane.normal));
    edge_sample(fan, plane.turn, s);
  }
  s.normal = plane.normal;
  return s;
}

StopReason why_unconverged(const ContactMesh& mesh, const IterationResult& now, const RunMemory& memory, int budget) {
  if (now.plane.feature == Feature::edge && mesh.edge_kind(now.plane.triangle, now.plane.side) == EdgeKind::boundary)
    return StopReason::left_boundary;
  if (!now.stability.stable()) return StopReason::unstable;
  // No new least error in the second half: it goes round in circles rather than slowly home.
  return now.evaluations - memory.least_at > budget / 2 ? StopReason::cycling : StopReason::iteration_limit;
}

/// One iteration from an edge or vertex. True to go on.
bool iterate_feature(IterationContext& context, bool kept, int budget, RunMemory& memory, IterationResult& now) {
  Proposal next = now.plane.feature == Feature::edge ? next_from_edge(context, now.plane, memory, now)
                                                     : next_from_vertex(context, now.plane, memory, now, kept);
  if (next.stop == StopReason::going_on && now.evaluations >= budget)
    next.stop = why_unconverged(context.cache.mesh(), now, memory, budget);
  if (context.trace)
    record(context, now, next.step, std::abs(next.step.da) * glm::length(now.sample.point_u), next.stop);
  now.stop = next.stop;
  if (next.stop != StopReason::going_on) return false;
  now.triangle_changes += next.triangle_changes;
  now.plane.move_to(next.place);
  return true;
}

/// One iteration from a face. True to go on.
bool iterate_face(IterationContext& context, int budget, RunMemory& memory, IterationResult& now) {
  const bool exact = now.contact.error_m < context.settings.tolerance_m, round = is_round(context.finger);
  ContactJacobian jacobian;
  if (!exact || !round) jacobian = contact_jacobian(context.finger, context.pose, now.sample, now.contact);
  now.stability = round ? now.bend.at_height(now.contact.height_m) : face_stability(now.sample, jacobian);
  if (exact) {
    now.stop = context.settings.method == Method::robust && !now.stability.stable() ? StopReason::unstable
                                                                                    : StopReason::converged;
    if (context.trace) record(context, now, ParameterStep{}, 0.0, now.stop);
    return false;
  }
  ParameterStep step = face_step(context, now, jacobian);
  if (!round && context.settings.method == Method::robust && step.valid) memory.rein_in(now, step);
  const ContactMesh& mesh = context.cache.mesh();
  now.stop = step.valid ? StopReason::going_on : StopReason::singular_patch;
  if (step.valid && now.evaluations >= budget) now.stop = why_unconverged(mesh, now, memory, budget);
  if (context.trace) record(context, now, step, step_length(mesh, now.plane.triangle, step), now.stop);
  if (now.stop != StopReason::going_on) return false;
  if (move_on_face(context, step, now)) return true;
  now.stop = StopReason::too_far;
  if (context.trace) context.trace->amend_last(now.stop);
  return false;
}

/// The sample of now.plane, and how it bends.
void sample_plane(IterationContext& context, IterationResult& now) {
  sample_place(context, now.plane, now.sample);
  if (now.plane.feature == Feature::face) now.bend = normal_bend(now.sample);
}

void run(IterationContext& context, bool kept, int budget, IterationResult& now) {
  now.triangle_changes = 0;
  now.met_unstable = false;
  RunMemory memory;
  for (bool first = kept;; first = false) {
    contact_on_plane(context.finger, context.pose, now.sample.point, now.sample.normal, now.contact);
    memory.add_error(now.contact.error_m, now.evaluations);
    const bool go_on = now.plane.feature == Feature::face ? iterate_face(context, budget, memory, now)
                                                          : iterate_feature(context, first, budget, memory, now);
    now.met_unstable |= !now.stability.stable();
    if (!go_on) return;
    sample_plane(context, now);
    ++now.evaluations;
  }
}

}  // namespace

void iterate(IterationContext& context, const SurfacePlace& start, int budget, IterationResult& result) {
  result.plane.move_to(start);
  sample_plane(context, result);
  result.evaluations = 1;
  run(context, false, budget, result);
}

void iterate_kept(IterationContext& context, const TrackedPlane& kept, bool sample_kept, int budget,
                  IterationResult& result) {
  if (!sample_kept) {
    result.plane = kept;
    result.sample = kept_place_sample(context, result.plane);
    if (result.plane.feature == Feature::face) result.bend = normal_bend(result.sample);
  }
  result.plane.point = result.sample.point;
  result.plane.normal = result.sample.normal;
  result.evaluations = 0;
  run(context, true, budget, result);
}

}  // namespace tangent
