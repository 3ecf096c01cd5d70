#include "core/planar/follow.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Slope below which a Newton step of `robust` is taken; nearer to zero it leaps.
constexpr double kNewtonSlope = -0.05;
/// Longest step of `robust` on a patch, in parameters, and the one taken where the contact is unstable.
constexpr double kLongestStep = 1.0, kDownhillStep = 0.25;
/// Patches that one step of `robust` may cross: at 1 m/s a finger crosses a metre in a million patches at that rate.
constexpr std::uint32_t kMostPatches = 1024;
/// After so many that were looked at one by one the index is asked for those that follow.
constexpr std::uint32_t kLooksBetweenRuns = 8;

/// A tangent line with the finger's contact on it.
struct Line {
  PlanarPlace place;
  Vec2 contact{0.0};
  double height = 0.0, error = 0.0, curvature = 0.0;
  double residual = 0.0;  ///< parameter of the contact less that of the line
  bool ahead = false;     ///< the contact is ahead of the line's place
  double slope = -1.0;    ///< derivative of the residual by t: -(1 + height * curvature)
};

class Follower {
 public:
  double stability_at(std::uint32_t patch, double t) const { return -patch_line(patch, t).slope; }

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
    line.ahead = glm::dot(line.contact - s.place, s.direction) > 0.0;
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
    double t = next_parameter(line);
    if (x_.settings.method == Method::robust) stay_between(line, t);
    if (!std::isfinite(t)) return StopReason::singular_patch;
    next = {Feature::face, line.place.patch, t, {}, {}};
    if (t < 0.0) return cross_end(line, false, next);
    if (t > 1.0) return cross_end(line, true, next);
    return StopReason::going_on;
  }

  /// A patch that the finger is ahead of at its start and behind of at its end holds the contact. A step that would
  /// leave it, or the part of it that is left after the lines so far, halves that part.
  void stay_between(const Line& line, double& t) {
    if (line.place.patch != between_) {
      between_ = line.place.patch;
      const CurvePatch& p = x_.curve.patch(between_);
      holds_ = ahead_at_start(p, x_.centre) >= 0.0 && ahead_at_end(p, x_.centre) <= 0.0;
      low_ = 0.0, high_ = 1.0;
    }
    if (!holds_) return;
    (line.ahead ? low_ : high_) = line.place.t;
    if (!(t >= low_ && t <= high_)) t = 0.5 * (low_ + high_);
  }

  StopReason cross_end(const Line& line, bool after, PlanarPlace& next) {
    const std::uint32_t patch = line.place.patch;
    const CurvePatch& p = x_.curve.patch(patch);
    const CurveJoint joint = after ? p.joint_after : p.joint_before;
    const bool robust = x_.settings.method == Method::robust;
    if (joint == CurveJoint::smooth) {
      next.patch = after ? x_.curve.after(patch) : x_.curve.before(patch);
      ++out_.patch_changes;
      const bool walked = robust && walk_on(after, next.patch);
      // The contact's angle seen from the new centre can lie on the old side of the joint.
      next.t = std::clamp(x_.curve.parameter(next.patch, centre_, walked ? x_.centre : line.contact), 0.0, 1.0);
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

  /// Goes on over patches that the finger has passed as a whole, without evaluating lines on them.
  bool walk_on(bool after, std::uint32_t& patch) {
    std::uint32_t crossed = 0, looks = 0;
    while (crossed < kMostPatches) {
      const CurvePatch& p = x_.curve.patch(patch);
      if (after ? !(ahead_at_end(p, x_.centre) > 0.0) : !(ahead_at_start(p, x_.centre) < 0.0)) break;
      if ((after ? p.joint_after : p.joint_before) != CurveJoint::smooth) break;
      patch = after ? x_.curve.after(patch) : x_.curve.before(patch);
      ++crossed;
      if (++looks % kLooksBetweenRuns == 0) crossed += skip_runs(after, kMostPatches - crossed, patch);
    }
    out_.patch_changes += static_cast<int>(crossed);
    return crossed > 0;
  }

  /// Over runs of patches that it has passed, `most` at most. How many they were.
  std::uint32_t skip_runs(bool after, std::uint32_t most, std::uint32_t& patch) const {
    const std::uint32_t next = x_.curve.index().first_not_passed(patch, after, x_.centre);
    if (next == kNone) return 0;
    const std::uint32_t skipped = std::min(after ? next - patch : patch - next, most);
    patch = after ? patch + skipped : patch - skipped;
    return skipped;
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
  std::uint32_t between_ = kNone;  ///< patch of which low_ and high_ tell
  bool holds_ = false;
  double low_ = 0.0, high_ = 1.0;
  PlanarContact out_;
};

}  // namespace

double ahead_at_start(const CurvePatch& p, const Vec2& centre) {
  const Vec2 way = p.vertex == p.first ? p.last - p.first : p.vertex - p.first;
  return glm::dot(centre - p.first, way);
}

double ahead_at_end(const CurvePatch& p, const Vec2& centre) {
  const Vec2 way = p.vertex == p.last ? p.last - p.first : p.last - p.vertex;
  return glm::dot(centre - p.last, way);
}

double stability_at(const PlanarContext& context, std::uint32_t patch, double t) {
  return Follower(context).stability_at(patch, t);
}

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
    // Within the fan: past the end of the one side and before the start of the other.
    if (glm::dot(arm, in) < 0.0 || glm::dot(arm, out) > 0.0) return false;
    // Convex towards the finger: stable from outside. In a notch only a finger behind the surface rests on the vertex.
    if (x.curve.side() * cross(in, out) > 0.0) sign = -1.0;
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
