#include "core/lab/explain/causes.h"

#include <algorithm>
#include <utility>

namespace tangent {
namespace {

constexpr std::uint32_t kMostPatchesOnTheWay = 256;

Vec3 direction_at(const TickStudy& study, std::uint32_t patch, bool end) {
  return lifted(study.planar()->sample(patch, study.preset().solver.local_centre, end ? 1.0 : 0.0).direction);
}

/// An end of a patch at which the curve is not smooth.
TickCause planar_feature_at(TickStudy& study, std::uint32_t patch, bool end, double error_m) {
  const PlanarCurve& curve = *study.planar();
  const CurvePatch& p = curve.patch(patch);
  study.place_at(patch, end ? 1 : 0, lifted(curve.origin() + p.vertex));
  if ((end ? p.joint_after : p.joint_before) == CurveJoint::corner) {
    const std::uint32_t other = end ? curve.after(patch) : curve.before(patch);
    const double turn = angle_between_deg(direction_at(study, patch, end), direction_at(study, other, !end));
    study.result.decided = {"turn of the normal at the corner", "what counts as a jump", "deg", turn, kJumpDeg};
    return TickCause::crease;
  }
  study.result.decided = {"error where the polygon ends", "tolerance", "m", error_m, study.preset().solver.tolerance_m};
  if (is_converged(study.tick().status) && !study.trials.is_first())
    study.result.decided = {"turn of the normal in one tick", "what counts as a jump", "deg",
                            angle_between_deg(study.before().plane.normal, study.tick().normal), kJumpDeg};
  return TickCause::boundary;
}

bool is_smooth_at(const CurvePatch& p, bool end) {
  return (end ? p.joint_after : p.joint_before) == CurveJoint::smooth;
}

/// The first end on the shorter way from one patch to another at which the curve is not smooth.
std::optional<std::pair<std::uint32_t, bool>> joint_between(const PlanarCurve& curve, std::uint32_t from,
                                                            std::uint32_t to) {
  const std::uint32_t count = curve.patch_count();
  const std::uint32_t on = (to + count - from) % count, back = (from + count - to) % count;
  const bool forward = curve.closed() ? on <= back : from < to;
  std::uint32_t patch = from;
  for (std::uint32_t i = std::min({forward ? on : back, kMostPatchesOnTheWay}); i > 0; --i) {
    if (!is_smooth_at(curve.patch(patch), forward)) return std::pair{patch, forward};
    patch = forward ? curve.after(patch) : curve.before(patch);
  }
  return std::nullopt;
}

}  // namespace

std::optional<TickCause> find_planar_feature(TickStudy& study) {
  const PlanarCurve& curve = *study.planar();
  for (std::size_t i = study.near.size(); i-- > 0;) {
    const IterationRecord& r = study.near[i];
    const bool end = r.u > 0.5;
    const bool on_end = r.feature == Feature::vertex || r.u == 0.0 || r.u == 1.0;
    if (on_end && !is_smooth_at(curve.patch(r.triangle), end))
      return planar_feature_at(study, r.triangle, end, r.error_m);
    if (i + 1 == study.run.size()) continue;
    if (const auto met = joint_between(curve, r.triangle, study.run[i + 1].triangle))
      return planar_feature_at(study, met->first, met->second, r.error_m);
  }
  return std::nullopt;
}

}  // namespace tangent
