#include "workbench/session/surface_switch.h"

#include "workbench/session/arming.h"
#include "workbench/session/servo_record.h"

namespace tangent {

bool SurfaceSwitch::update(const TickOutput& output, double dt_s) noexcept {
  if (!wish_.felt) {
    const bool nothing = output.force_n == Vec3(0.0);
    share_ = nothing ? 0.0 : std::max(0.0, share_ - dt_s / kSurfaceFade_s);
    return false;
  }
  pull_share_ = 0.0;
  if (share_ == 1.0) return false;
  // Also one that was on its way out: from where it is it would come back as a push.
  const bool off = is_converged(output.status) && force_wanted_n(output) <= kMostArmingForce_n;
  share_ = off ? 1.0 : std::max(0.0, share_ - dt_s / kSurfaceFade_s);
  return off;
}

// A spring whose force ends at a limit: what it offers is the work of the whole way to its place.
SurfacePull SurfaceSwitch::pull(const Vec3& finger_m, double dt_s) noexcept {
  SurfacePull out;
  const bool pulls = !wish_.felt && wish_.pull && share_ == 0.0;
  if (!pulls || !(wish_.pull_n_per_m > 0.0) || !(wish_.pull_limit_n > 0.0) || !is_finite(finger_m)) {
    pull_share_ = 0.0;
    return out;
  }
  const double before = pull_share_;
  pull_share_ = std::min(1.0, pull_share_ + dt_s / kPullFade_s);
  const Vec3 way = wish_.pull_to_m - finger_m;
  const double far_m = glm::length(way);
  out.stiffness_n_per_m = wish_.pull_n_per_m;
  out.elastic_n = wish_.pull_n_per_m * far_m;
  const double force_n = std::min(out.elastic_n, wish_.pull_limit_n);
  if (far_m > 0.0) out.force_n = pull_share_ * force_n / far_m * way;
  out.declared_j = (pull_share_ - before) * stored_energy({wish_.pull_n_per_m, out.elastic_n, wish_.pull_limit_n});
  return out;
}

}  // namespace tangent
