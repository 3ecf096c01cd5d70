#include "core/contact/follow/run.h"

namespace tangent {

void record(ContactContext& context, const IterationResult& now, const ParameterStep& step, double step_m,
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

StopReason why_unconverged(const ContactMesh& mesh, const IterationResult& now, const RunMemory& memory, int budget) {
  if (now.plane.feature == Feature::edge && mesh.edge_kind(now.plane.triangle, now.plane.side) == EdgeKind::boundary)
    return StopReason::left_boundary;
  if (!now.stability.stable()) return StopReason::unstable;
  // No new least error in the second half: it goes round in circles rather than slowly home.
  return now.evaluations - memory.least_at > budget / 2 ? StopReason::cycling : StopReason::iteration_limit;
}

}  // namespace tangent
