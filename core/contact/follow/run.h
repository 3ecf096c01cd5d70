// One run of the iteration, seen from inside: where it goes next, what it remembers, what it shows, why it ends.
#pragma once

#include "core/contact/follow/step_rule.h"

namespace tangent {

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

/// Adds the present plane to the tick's trace. `step_m`: length of the step on the base triangle.
void record(ContactContext& context, const IterationResult& now, const ParameterStep& step, double step_m,
            StopReason stop);

/// Of a run that has spent its `budget` of planes.
StopReason why_unconverged(const ContactMesh& mesh, const IterationResult& now, const RunMemory& memory, int budget);

}  // namespace tangent
