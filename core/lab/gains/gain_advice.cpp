#include "core/lab/gains/gain_advice.h"

#include "core/finger/plane_contact.h"
#include "core/lab/gains/paper_contraction.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {

namespace {

constexpr double kNoGain = 1e-4;      // of the error: no step for less
constexpr double kWorthAWalk = 0.02;  // the rule's gains are simpler, and serve elsewhere too

/// Downhill over the three gains, with steps that halve from sixteen units of the grid to one.
template <class Left>
Gains walk_downhill(Gains at, const GainGrid& grid, const Left& left) {
  double least = left(at);
  for (double unit = 16.0; unit >= 1.0; unit *= 0.5) {
    const auto moved = [&](int axis, double sign) {
      Gains to = at;
      double& value = axis == 0 ? to.overall : axis == 1 ? to.curvature_m : to.distance_per_m;
      const double fine = axis == 0 ? grid.fine.overall : axis == 1 ? grid.fine.curvature_m : grid.fine.distance_per_m;
      const double largest = axis == 0   ? grid.largest.overall
                             : axis == 1 ? grid.largest.curvature_m
                                         : grid.largest.distance_per_m;
      value = std::clamp(std::round(value / fine + sign * unit) * fine, 0.0, largest);
      return to;
    };
    for (bool better = true; better;) {
      better = false;
      for (int move = 0; move < 6; ++move) {
        const Gains to = moved(move / 2, move % 2 == 0 ? 1.0 : -1.0);
        const double there = left(to);
        if (!(there < least - kNoGain)) continue;
        least = there;
        at = to;
        better = true;
      }
    }
  }
  return at;
}

}  // namespace

bool GainAdvice::better() const {
  if (!local || !std::isfinite(left_advised)) return false;
  return !std::isfinite(left_now) || std::round(100.0 * left_advised) < std::round(100.0 * left_now);
}

GainAdvice advise_gains(const ContactMesh& mesh, const Preset& preset, const std::optional<TickOutput>& at, bool walk) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  GainAdvice out;
  out.gain_curvature_m = out.height_m = preset.finger.reach_m();
  out.advised = {1.0, out.gain_curvature_m, 0.0};
  out.k1_per_m = out.k2_per_m = out.ideal1 = out.ideal2 = out.left_now = out.left_advised = kNothing;
  if (!at || at->status != TickStatus::face || at->triangle == kNone || at->triangle >= mesh.triangle_count() ||
      !mesh.usable(at->triangle))
    return out;
  const PnPatch patch = make_patch(mesh, at->triangle, preset.solver.normal_form);
  const SurfaceSample s = evaluate(patch, at->u, at->v);
  const PrincipalCurvatures k = principal_curvatures(s, evaluate_second(patch, at->u, at->v));
  const FingerPose pose = pose_touching(preset.finger, s, at->penetration_m);
  out.height_m = contact_on_plane(preset.finger, pose, s.point, s.normal).height_m;
  out.k1_per_m = k.k1;
  out.k2_per_m = k.k2;
  out.ideal1 = 1.0 / (1.0 + out.height_m * k.k1);
  out.ideal2 = 1.0 / (1.0 + out.height_m * k.k2);
  const auto left = [&](const Gains& gains) {
    Preset with = preset;
    with.solver = with_gains(with.solver, gains);
    return paper_contraction(mesh, at->triangle, s, with, at->penetration_m);
  };
  out.left_now = left(gains_of(preset.solver));
  out.left_advised = left(out.advised);
  if (walk && out.gain_curvature_m > 0.0 && out.left_advised > kNoGain) {
    const Gains found = walk_downhill(out.advised, make_gain_grid(out.gain_curvature_m), left);
    if (left(found) < out.left_advised - kWorthAWalk) out.advised = found;
    out.left_advised = left(out.advised);
  }
  out.local = true;
  return out;
}

}  // namespace tangent
