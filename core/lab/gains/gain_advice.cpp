#include "core/lab/gains/gain_advice.h"

#include "core/finger/plane_contact.h"
#include "core/lab/gains/paper_contraction.h"
#include "core/surface/mesh_patch.h"

#include <limits>

namespace tangent {

GainAdvice advise_gains(const ContactMesh& mesh, const Preset& preset, const std::optional<TickOutput>& at) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  GainAdvice out;
  out.gain_curvature_m = out.height_m = preset.finger.reach_m();
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
  out.left_now = paper_contraction(mesh, at->triangle, s, preset, at->penetration_m);
  Preset advised = preset;
  advised.solver.gain_overall = 1.0;
  advised.solver.gain_curvature_m = out.gain_curvature_m;
  advised.solver.gain_distance_per_m = 0.0;
  out.left_advised = paper_contraction(mesh, at->triangle, s, advised, at->penetration_m);
  out.local = true;
  return out;
}

}  // namespace tangent
