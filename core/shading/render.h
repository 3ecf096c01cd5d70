// From decided planes to what the devices get: force and place of contact. Where the planes come from is not known
// here.
#pragma once

#include "core/finger/finger.h"
#include "core/preset/preset.h"

namespace tangent {

/// Share of a plane whose ramp was over before this tick: nothing to render, and what is still rendered, as after ticks
/// that found no contact at all, is no part of that ramp. It fades like every decision.
inline constexpr double kRampWasOver = -1.0;

/// A plane in the world and how deep the finger is in it.
struct RenderPlane {
  Vec3 normal;  ///< unit
  double penetration_m;
  double share;  ///< 1; less while an unconverged tick ramps out; 0 or kRampWasOver: nothing to render
};

/// Touched nowhere.
inline constexpr RenderPlane kNoPlane{{0.0, 0.0, 1.0}, 0.0, 1.0};

/// What the devices get.
struct Rendered {
  Vec3 force_n{0.0};       ///< on the finger, world, N
  double cld_m = 0.0;      ///< of the contact location display, from its centre, m
  bool ramps_out = false;  ///< an unconverged tick on its way to zero
  bool off_pad = false;    ///< the contact is where no display reaches, and cld_m says nothing
};

/// Force from one plane and place from another. `tactile`: null: the display is held at its centre. `section`: of the
/// finger, world; `velocity`: of the finger, world, m/s.
Rendered render(const Preset& preset, const RenderPlane& force, const RenderPlane* tactile,
                const FingerSection& section, const Vec3& velocity);

/// 1 for `unconverged_hold_s` after the last converged tick, then falling to 0 over `unconverged_ramp_s`.
double unconverged_share(const SafetySettings& safety, double since_s);

}  // namespace tangent
