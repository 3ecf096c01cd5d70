// `run` is the loop; faces, edges and vertices each have their own way of going on.
#include "core/contact/iterate.h"

#include "core/contact/step_rule.h"
#include "core/contact/vertex_fan.h"
#include "core/contact/walk.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Where an iteration goes next, and what the trace shows of the step.
struct Proposal {
  TrackedPlane place;
  ParameterStep step;
  double step_m = 0.0;
  int triangle_changes = 0;
  StopReason stop = StopReason::going_on;  ///< converged, or why there is no next place
};

PlaceSample face_sample(const SurfaceSample& s) {
  return {s.point, s.point_u, s.point_v, s.normal, s.normal_u, s.normal_v};
}

PlaceSample edge_sample(const EdgeFan& fan, double turn) {
  const FanNormal n = fan_normal(fan, turn);
  return {fan.point, fan.point_f, Vec3(0.0), n.normal, n.by_f, n.by_turn};
}

/// `turn` brought into [0, fan] by the shorter way round.
double clamp_turn(double turn, double fan) {
  if (turn >= 0.0 && turn <= fan) return turn;
  constexpr double kTurn = 6.283185307179586;
  const double below = turn < 0.0 ? -turn : kTurn - turn;
  const double above = turn > fan ? turn - fan : kTurn + turn - fan;
  return below <= above ? 0.0 : fan;
}

double turn_of(const EdgeFan& fan, const Vec3& normal) {
  return clamp_turn(std::atan2(glm::dot(normal, fan.e2), glm::dot(normal, fan.e1)), fan.fan);
}

TrackedPlane face_place(std::uint32_t t, double u, double v) {
  TrackedPlane p;
  p.feature = Feature::face;
  p.triangle = t;
  p.u = u;
  p.v = v;
  return p;
}

TrackedPlane edge_place(std::uint32_t t, std::uint32_t edge, double f) {
  const Vec2 uv = edge_point_uv(edge, f);
  TrackedPlane p = face_place(t, uv.x, uv.y);
  p.feature = Feature::edge;
  p.side = static_cast<std::uint8_t>(edge);
  return p;
}

/// Stability and step of a face; says whether it has converged or why there is no step.
StopReason face_step(IterationContext& context, IterationResult& now, ParameterStep& step) {
  const ContactJacobian jacobian = contact_jacobian(context.finger, context.pose, now.sample, now.contact);
  now.stability = face_stability(now.sample, jacobian);
  const Method method = context.settings.method;
  if (now.contact.error_m < context.settings.tolerance_m)
    return method == Method::robust && !now.stability.stable() ? StopReason::unstable : StopReason::converged;
  switch (method) {
    case Method::newton: step = newton_step(now.sample, jacobian, now.contact); break;
    case Method::robust: step = robust_face_step(now.sample, jacobian, now.stability, now.contact); break;
    default: step = paper_face_step(context.cache.mesh(), context.settings, now.plane.triangle, now.sample, now.contact); break;
  }
  return step.valid ? StopReason::going_on : StopReason::singular_patch;
}

/// Walks from a face; false if the walk got lost.
bool move_on_face(const ContactMesh& mesh, const ParameterStep& step, IterationResult& now) {
  if (stays_inside(now.plane.u, now.plane.v, step.da, step.db)) {
    now.plane.u += step.da;
    now.plane.v += step.db;
    return true;
  }
  const WalkResult walk = walk_face(mesh, now.plane.triangle, now.plane.u, now.plane.v, step.da, step.db);
  if (walk.lost) return false;  // the plane stays with its sample
  now.plane = walk.place;
  now.triangle_changes += walk.triangle_changes;
  return true;
}

double step_length(const ContactMesh& mesh, std::uint32_t t, const ParameterStep& step) {
  const Vec3 s = step.da * (mesh.position(t, 1) - mesh.position(t, 0)) + step.db * (mesh.position(t, 2) - mesh.position(t, 0));
  return std::sqrt(glm::dot(s, s));
}

/// A move along an edge, on to the vertex where it passes an end.
TrackedPlane move_along_edge(const TrackedPlane& at, double f, double df) {
  if ((f >= 1.0 && df > 0.0) || (f <= 0.0 && df < 0.0)) {
    TrackedPlane p = at;
    p.feature = Feature::vertex;
    p.side = static_cast<std::uint8_t>(f >= 1.0 ? (at.side + 1) % 3 : at.side);
    return p;
  }
  return edge_place(at.triangle, at.side, std::clamp(f + df, 0.0, 1.0));
}

Proposal next_from_edge(IterationContext& context, const TrackedPlane& at, IterationResult& now) {
  Proposal next;
  const ContactMesh& mesh = context.cache.mesh();
  const double f = edge_fraction(at.side, at.u, at.v);
  const EdgeFan fan = edge_fan(context.cache, at.triangle, at.side, f, context.settings.normal_form);
  const double turn = turn_of(fan, now.sample.normal);
  const ContactJacobian jacobian = contact_jacobian(context.finger, context.pose, now.sample, now.contact);
  // Along the edge the contact is stable when a step along it moves the plane's contact the same way; across
  // it the fan is convex, which is stable for a finger outside (h > 0).
  const double along = glm::dot(jacobian.xa, fan.tangent) * (glm::dot(fan.point_f, fan.tangent) > 0.0 ? 1.0 : -1.0);
  const double across = glm::dot(jacobian.xb, now.sample.normal_b);
  now.stability = {along * across, along + across};
  if (now.contact.error_m < context.settings.tolerance_m && now.stability.stable()) {
    next.stop = StopReason::converged;
    return next;
  }

  ParameterStep newton = newton_step(now.sample, jacobian, now.contact);
  const double speed2 = glm::dot(fan.point_f, fan.point_f);
  const double df_travel = speed2 > 0.0 ? glm::dot(now.contact.travel, fan.point_f) / speed2 : 0.0;
  const bool trust_newton = newton.valid && along > 0.0 && across > 0.0;
  if (!trust_newton) newton.da = df_travel, newton.db = 0.0;
  next.step = newton;
  next.step.valid = true;
  const double slide_m = std::abs(df_travel) * std::sqrt(speed2);

  // At an end of the fan the plane wants to turn on into the face.
  const double wanted = facing_turn(fan, context.finger, context.pose);
  const bool at_near = turn <= 0.0, at_far = turn >= fan.fan;
  const bool outside = wanted < 0.0 || wanted > fan.fan;
  const EdgeLink other = mesh.across(at.triangle, at.side);
  const bool paper = context.settings.method == Method::paper;
  const bool leave_near = at_near && (paper ? outside : trust_newton ? newton.db < 0.0 : outside);
  const bool leave_far = at_far && other.triangle != kNone && (paper ? outside : trust_newton ? newton.db > 0.0 : outside);
  if (paper) {
    next.step.curvature_per_m = directional_curvature({now.sample.point, now.sample.point_a, now.sample.point_b,
                                                       now.sample.normal, now.sample.normal_a, now.sample.normal_b}, 1.0, 0.0);
    next.step.distance_m = paper_distance(context.settings, now.contact);
    next.step.gain = paper_gain(context.settings, next.step.curvature_per_m, next.step.distance_m);
    next.step.da = next.step.gain * df_travel;
    // Slide along the edge first: what is left across it then says which face, without going to and fro.
    if ((leave_near || leave_far) && slide_m > 0.5 * now.contact.error_m) {
      next.place = move_along_edge(at, f, next.step.da);
      next.step_m = std::abs(next.step.da) * std::sqrt(speed2);
      return next;
    }
  }
  if (leave_near) {
    next.place = face_place(at.triangle, at.u, at.v);
    return next;
  }
  if (leave_far) {
    const Vec2 uv = edge_point_uv(other.edge, 1.0 - f);
    next.place = face_place(other.triangle, uv.x, uv.y);
    next.triangle_changes = 1;
    return next;
  }
  next.place = move_along_edge(at, f, std::clamp(next.step.da, -1.0, 1.0));
  next.step_m = std::abs(next.step.da) * std::sqrt(speed2);
  if (next.place.feature == Feature::edge && next.place.u == at.u && next.place.v == at.v &&
      std::abs(wanted - turn) < 1e-12 && !outside) {
    // Neither the place nor the plane can change any more.
    next.stop = now.contact.error_m < context.settings.tolerance_m ? StopReason::unstable : StopReason::singular_patch;
  }
  return next;
}

Proposal next_from_vertex(IterationContext& context, const TrackedPlane& at, IterationResult& now, bool kept) {
  Proposal next;
  now.stability = now.contact.height_m > 0.0 ? Stability{1.0, 2.0} : Stability{0.0, 0.0};
  const VertexExit exit = vertex_exit(context, at);
  next.step.valid = true;
  if (!exit.place) {
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

void record(IterationContext& context, const IterationResult& now, const ParameterStep& step, double step_m, StopReason stop) {
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
  if (r.curvature_per_m == 0.0)
    r.curvature_per_m = directional_curvature({now.sample.point, now.sample.point_a, now.sample.point_b, now.sample.normal,
                                               now.sample.normal_a, now.sample.normal_b}, step.da, step.db);
  r.distance_m = paper_distance(context.settings, now.contact);
  r.step_m = step_m;
  r.det_m = now.stability.det;
  r.trace_m = now.stability.trace;
  context.trace->push(r);
}

}  // namespace

PlaceSample sample_place(IterationContext& context, TrackedPlane& plane) {
  PlaceSample s;
  const NormalForm form = context.settings.normal_form;
  if (plane.feature == Feature::edge) {
    const EdgeFan fan = edge_fan(context.cache, plane.triangle, plane.side, edge_fraction(plane.side, plane.u, plane.v), form);
    s = edge_sample(fan, clamp_turn(facing_turn(fan, context.finger, context.pose), std::max(0.0, fan.fan)));
  } else if (plane.feature == Feature::vertex) {
    s = vertex_sample(context, plane);
  } else {
    s = face_sample(evaluate(context.cache.patch(plane.triangle, form), plane.u, plane.v));
  }
  plane.point = s.point;
  plane.normal = s.normal;
  return s;
}

namespace {

/// Sample of the plane kept from the last tick: edges and vertices keep the normal they had.
PlaceSample kept_place_sample(IterationContext& context, const TrackedPlane& plane) {
  TrackedPlane copy = plane;
  if (plane.feature == Feature::face) return sample_place(context, copy);
  if (plane.feature == Feature::vertex) return vertex_sample_at(context, plane, plane.normal);
  const EdgeFan fan = edge_fan(context.cache, plane.triangle, plane.side, edge_fraction(plane.side, plane.u, plane.v),
                               context.settings.normal_form);
  PlaceSample s = edge_sample(fan, turn_of(fan, plane.normal));
  s.normal = plane.normal;
  return s;
}

/// How the error went so far; says why an iteration that spent its budget did not converge.
struct ErrorHistory {
  double least = 1e300;
  int least_at = 0;

  void add(double error, int evaluation) {
    if (error >= 0.99 * least) return;
    least = error;
    least_at = evaluation;
  }
};

StopReason why_unconverged(const ContactMesh& mesh, const IterationResult& now, const ErrorHistory& errors, int budget) {
  if (now.plane.feature == Feature::edge && mesh.edge_kind(now.plane.triangle, now.plane.side) == EdgeKind::boundary)
    return StopReason::left_boundary;
  if (!now.stability.stable()) return StopReason::unstable;
  // No new least error in the second half: it goes round in circles rather than slowly home.
  return now.evaluations - errors.least_at > budget / 2 ? StopReason::cycling : StopReason::iteration_limit;
}

/// One iteration from an edge or vertex. True to go on.
bool iterate_feature(IterationContext& context, bool kept, int budget, const ErrorHistory& errors, IterationResult& now) {
  Proposal next = now.plane.feature == Feature::edge ? next_from_edge(context, now.plane, now)
                                                     : next_from_vertex(context, now.plane, now, kept);
  if (next.stop == StopReason::going_on && now.evaluations >= budget)
    next.stop = why_unconverged(context.cache.mesh(), now, errors, budget);
  if (context.trace) record(context, now, next.step, next.step_m, next.stop);
  now.stop = next.stop;
  if (next.stop != StopReason::going_on) return false;
  now.triangle_changes += next.triangle_changes;
  now.plane = next.place;
  return true;
}

/// One iteration from a face. True to go on.
bool iterate_face(IterationContext& context, int budget, const ErrorHistory& errors, IterationResult& now) {
  ParameterStep step;
  now.stop = face_step(context, now, step);
  const ContactMesh& mesh = context.cache.mesh();
  if (now.stop == StopReason::going_on && now.evaluations >= budget) now.stop = why_unconverged(mesh, now, errors, budget);
  if (context.trace) record(context, now, step, step_length(mesh, now.plane.triangle, step), now.stop);
  if (now.stop != StopReason::going_on) return false;
  if (move_on_face(mesh, step, now)) return true;
  now.stop = StopReason::too_far;
  if (context.trace) context.trace->amend_last(now.stop);
  return false;
}

void run(IterationContext& context, bool kept, int budget, IterationResult& now) {
  now.triangle_changes = 0;
  now.met_unstable = false;
  ErrorHistory errors;
  for (bool first = kept;; first = false) {
    now.contact = contact_on_plane(context.finger, context.pose, now.sample.point, now.sample.normal);
    errors.add(now.contact.error_m, now.evaluations);
    const bool go_on = now.plane.feature == Feature::face ? iterate_face(context, budget, errors, now)
                                                          : iterate_feature(context, first, budget, errors, now);
    now.met_unstable |= !now.stability.stable();
    if (!go_on) return;
    now.sample = sample_place(context, now.plane);
    ++now.evaluations;
  }
}

}  // namespace

void iterate(IterationContext& context, const TrackedPlane& start, int budget, IterationResult& result) {
  result.plane = start;
  result.sample = sample_place(context, result.plane);
  result.evaluations = 1;
  run(context, false, budget, result);
}

void iterate_kept(IterationContext& context, const TrackedPlane& kept, bool sample_kept, int budget, IterationResult& result) {
  if (!sample_kept) {
    result.plane = kept;
    result.sample = kept_place_sample(context, kept);
  }
  result.plane.point = result.sample.point;
  result.plane.normal = result.sample.normal;
  result.evaluations = 0;
  run(context, true, budget, result);
}

}  // namespace tangent
