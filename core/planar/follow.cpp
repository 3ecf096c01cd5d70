#include "core/planar/follow.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Slope below which a Newton step of `robust` is taken; nearer to zero it leaps.
constexpr double kNewtonSlope = -0.05;
/// Longest step of `robust` on a patch, in parameters, and the one taken where the contact is unstable.
constexpr double kLongestStep = 1.0, kDownhillStep = 0.25;

/// A tangent line with the finger's contact on it.
struct Line {
  PlanarPlace place;
  Vec2 contact{0.0};
  double height = 0.0, error = 0.0, curvature = 0.0;
  double residual = 0.0;  ///< parameter of the contact less that of the line
  double slope = -1.0;    ///< derivative of the residual by t: -(1 + height * curvature)
};

class Follower {
 public:
  Follower(const PlanarContext& context) : x_(context), centre_(context.settings.local_centre) {}

  PlanarContact run(const PlanarPlace& start, bool kept, int budget) {
    Line line = start.feature == Feature::vertex ? vertex_line(start) : patch_line(start.patch, start.t);
    if (!kept) ++out_.evaluations;
    for (;;) {
      keep(line);
      if (done(line)) return out_;
      if (out_.evaluations >= budget) return stop(StopReason::iteration_limit, line);
      PlanarPlace next = line.place;
      const StopReason problem = advance(line, next);
      if (problem != StopReason::going_on) return stop(problem, line);
      record(line, StopReason::going_on, std::abs(next.t - line.place.t));
      line = next.feature == Feature::vertex ? vertex_line(next) : patch_line(next.patch, next.t);
      ++out_.evaluations;
    }
  }

 private:
  Line patch_line(std::uint32_t patch, double t) const {
    const LineSample s = x_.curve.sample(patch, centre_, t);
    Line line;
    line.place = {Feature::face, patch, t, s.place, s.normal};
    const Vec2 arm = x_.centre - s.foot;
    const double along = glm::dot(arm, s.direction);
    line.height = glm::dot(arm, s.normal);
    line.contact = s.foot + along * s.direction;
    line.error = glm::length(line.contact - s.place);
    line.curvature = rendered_curvature(s);
    line.residual = x_.curve.parameter(patch, centre_, line.contact) - t;
    const double along_t = glm::dot(arm, s.direction_t) - glm::dot(s.foot_t, s.direction);
    line.slope = x_.curve.parameter_rate(patch, centre_, line.contact,
                                         s.foot_t + along_t * s.direction + along * s.direction_t) -
                 1.0;
    return line;
  }

  Line vertex_line(const PlanarPlace& place) const {
    Line line;
    line.place = place;
    const Vec2 arm = x_.centre - place.point;
    line.height = glm::dot(arm, place.normal);
    line.contact = x_.centre - line.height * place.normal;
    line.error = glm::length(line.contact - place.point);
    return line;
  }

  bool done(const Line& line) {
    if (!(line.error < x_.settings.tolerance_m)) return false;
    // Outside [0, 1] a place belongs to the neighbour, but for rounding; robust does not rest on unstable ones.
    if (line.place.feature == Feature::face && x_.settings.method == Method::robust && line.slope >= 0.0) return false;
    stop(StopReason::converged, line);
    return true;
  }

  PlanarContact& stop(StopReason reason, const Line& line) {
    out_.stop = reason;
    record(line, reason, 0.0);
    return out_;
  }

  void keep(const Line& line) {
    out_.place = line.place;
    out_.height_m = line.height;
    out_.error_m = line.error;
    out_.stability = -line.slope;
  }

  double next_parameter(const Line& line) const {
    const double t = line.place.t;
    if (x_.settings.method == Method::paper) return t + line.residual;
    if (x_.settings.method == Method::newton) return t - line.residual / line.slope;
    if (line.slope <= kNewtonSlope) return t + std::clamp(-line.residual / line.slope, -kLongestStep, kLongestStep);
    // Unstable: the distance falls in the direction of the contact, however small the residual is.
    return t + (line.residual < 0.0 ? -kDownhillStep : kDownhillStep);
  }

  /// The next place after `line`; not `going_on`: there is none.
  StopReason advance(const Line& line, PlanarPlace& next) {
    if (line.place.feature == Feature::vertex) return leave_vertex(line, next);
    const double t = next_parameter(line);
    if (!std::isfinite(t)) return StopReason::singular_patch;
    next = {Feature::face, line.place.patch, t, {}, {}};
    if (t < 0.0) return cross_end(line, false, next);
    if (t > 1.0) return cross_end(line, true, next);
    return StopReason::going_on;
  }

  StopReason cross_end(const Line& line, bool after, PlanarPlace& next) {
    const std::uint32_t patch = line.place.patch;
    const CurvePatch& p = x_.curve.patch(patch);
    const CurveJoint joint = after ? p.joint_after : p.joint_before;
    if (joint == CurveJoint::smooth) {
      next.patch = after ? x_.curve.after(patch) : x_.curve.before(patch);
      next.t = std::clamp(x_.curve.parameter(next.patch, centre_, line.contact), 0.0, 1.0);
      // The contact's angle seen from the new centre can lie on the old side of the joint.
      ++out_.patch_changes;
      return StopReason::going_on;
    }
    PlanarContact corner;
    if (end_contact(x_, patch, after, corner)) {
      next = corner.place;
      return StopReason::going_on;
    }
    if (joint == CurveJoint::end) {
      if (line.place.t == (after ? 1.0 : 0.0)) return StopReason::left_boundary;
      next.t = after ? 1.0 : 0.0;
      return StopReason::going_on;
    }
    next.patch = after ? x_.curve.after(patch) : x_.curve.before(patch);
    next.t = std::clamp(x_.curve.parameter(next.patch, centre_, x_.centre), 0.0, 1.0);
    ++out_.patch_changes;
    // Deep in a notch each side points to the other.
    return out_.patch_changes > 2 * static_cast<int>(x_.curve.patch_count()) + 8 ? StopReason::cycling
                                                                                 : StopReason::going_on;
  }

  StopReason leave_vertex(const Line& line, PlanarPlace& next) {
    const std::uint32_t patch = line.place.patch;
    const bool after = line.place.t > 0.5;
    PlanarContact corner;
    if (end_contact(x_, patch, after, corner)) {
      next = corner.place;
      return StopReason::going_on;
    }
    next = {Feature::face, patch, line.place.t, {}, {}};
    const CurvePatch& p = x_.curve.patch(patch);
    const Vec2 outwards = after ? p.last - p.first : p.first - p.last;
    const CurveJoint joint = after ? p.joint_after : p.joint_before;
    if (joint == CurveJoint::corner && glm::dot(x_.centre - line.place.point, outwards) > 0.0) {
      next.patch = after ? x_.curve.after(patch) : x_.curve.before(patch);
      ++out_.patch_changes;
    }
    next.t = std::clamp(x_.curve.parameter(next.patch, centre_, x_.centre), 0.0, 1.0);
    return StopReason::going_on;
  }

  void record(const Line& line, StopReason reason, double parameter_step) {
    if (x_.trace == nullptr) return;
    const Vec3 origin = lifted(x_.curve.origin());
    IterationRecord r;
    r.feature = line.place.feature;
    r.stop = reason;
    r.seed = x_.seed;
    r.triangle = line.place.patch;
    r.u = line.place.t;
    r.point = origin + lifted(line.place.point);
    r.normal = lifted(line.place.normal);
    r.contact = origin + lifted(line.contact);
    r.travel = lifted(line.contact - line.place.point);
    r.error_m = line.error;
    r.gain = reason == StopReason::going_on ? 1.0 : 0.0;
    r.curvature_per_m = line.curvature;
    r.distance_m = x_.radius_m - line.height;
    const CurvePatch& p = x_.curve.patch(line.place.patch);
    r.step_m = parameter_step * glm::length(p.last - p.first);
    r.det_m = r.trace_m = -line.slope;
    x_.trace->push(r);
  }

  const PlanarContext& x_;
  LocalCentre centre_;
  PlanarContact out_;
};

}  // namespace

bool end_contact(const PlanarContext& x, std::uint32_t patch, bool after, PlanarContact& contact) {
  const CurvePatch& p = x.curve.patch(patch);
  const CurveJoint joint = after ? p.joint_after : p.joint_before;
  if (joint == CurveJoint::smooth) return false;
  const LocalCentre kind = x.settings.local_centre;
  const Vec2 point = p.vertex, arm = x.centre - point;
  const double distance = glm::length(arm);
  if (!(distance > 0.0)) return false;
  const LineSample here = x.curve.sample(patch, kind, after ? 1.0 : 0.0);
  double sign = 1.0;
  if (joint == CurveJoint::end) {
    if (!(glm::dot(arm, after ? here.direction : -here.direction) > 0.0)) return false;
  } else {
    const LineSample there =
        after ? x.curve.sample(x.curve.after(patch), kind, 0.0) : x.curve.sample(x.curve.before(patch), kind, 1.0);
    const Vec2 in = after ? here.direction : there.direction, out = after ? there.direction : here.direction;
    // Convex towards the finger: stable from outside. In a notch only a finger behind the surface rests on the vertex.
    if (x.curve.side() * cross(in, out) > 0.0) sign = -1.0;
    // Within the fan: past the end of the one side and before the start of the other.
    if (sign * glm::dot(arm, in) < 0.0 || sign * glm::dot(arm, out) > 0.0) return false;
    const Vec2 mean = here.normal + there.normal;
    if (glm::dot(sign * arm, mean) < 0.0) return false;
  }
  contact = {};
  contact.place = {Feature::vertex, patch, after ? 1.0 : 0.0, point, (sign / distance) * arm};
  contact.height_m = sign * distance;
  contact.stop = StopReason::converged;
  return true;
}

PlanarContact follow(const PlanarContext& context, const PlanarPlace& start, bool kept, int budget) {
  return Follower(context).run(start, kept, budget);
}

}  // namespace tangent
