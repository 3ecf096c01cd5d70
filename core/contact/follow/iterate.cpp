// `run` is the loop; faces, edges and vertices each have their own way of going on.
#include "core/contact/follow/iterate.h"

#include "core/contact/follow/edge.h"
#include "core/contact/follow/face.h"
#include "core/contact/follow/vertex.h"

#include <cmath>

namespace tangent {

void sample_place(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample) {
  if (plane.feature == Feature::face) {
    context.cache.sample(plane.triangle, context.settings.normal_form, plane.u, plane.v, sample);
  } else if (plane.feature == Feature::edge) {
    sample_edge(context, plane, sample);
  } else {
    sample = vertex_sample(context, plane);
  }
  plane.point = sample.point;
  plane.normal = sample.normal;
}

namespace {

/// Sample of the plane kept from the last tick: edges and vertices keep the normal they had.
void sample_kept(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample) {
  if (plane.feature == Feature::face) {
    context.cache.sample(plane.triangle, context.settings.normal_form, plane.u, plane.v, sample);
  } else if (plane.feature == Feature::edge) {
    sample_kept_edge(context, plane, sample);
  } else {
    sample = vertex_sample_at(context, plane, plane.normal);
  }
}

/// One iteration from an edge or vertex. True to go on.
bool iterate_feature(ContactContext& context, bool kept, int budget, RunMemory& memory, IterationResult& now) {
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

/// The sample of now.plane, and how it bends.
void sample_plane(ContactContext& context, IterationResult& now) {
  sample_place(context, now.plane, now.sample);
  if (now.plane.feature == Feature::face) now.bend = normal_bend(now.sample);
}

void run(ContactContext& context, bool kept, int budget, IterationResult& now) {
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

void iterate(ContactContext& context, const SurfacePlace& start, int budget, IterationResult& result) {
  result.plane.move_to(start);
  sample_plane(context, result);
  result.evaluations = 1;
  run(context, false, budget, result);
}

void iterate_kept(ContactContext& context, const TrackedPlane& kept, bool sample_is_kept, int budget,
                  IterationResult& result) {
  if (!sample_is_kept) {
    result.plane = kept;
    sample_kept(context, result.plane, result.sample);
    if (result.plane.feature == Feature::face) result.bend = normal_bend(result.sample);
  }
  result.plane.point = result.sample.point;
  result.plane.normal = result.sample.normal;
  result.evaluations = 0;
  run(context, true, budget, result);
}

}  // namespace tangent
