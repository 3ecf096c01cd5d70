#include "core/shading/blend.h"

#include "core/base/tolerances.h"
#include "core/shading/last_force.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// 0 where the force comes from the smooth surface, which has no edges of its own.
double force_rule(const Preset& preset) {
  const Method method = preset.solver.method;
  const ForceSource source = preset.force.source;
  if (source == ForceSource::smooth || (source == ForceSource::method && is_smooth(method))) return 0.0;
  const ForceSettings& f = preset.force;
  return 1.0 + static_cast<double>(source) + 8.0 * static_cast<double>(method) + f.stiffness_n_per_m +
         std::sqrt(2.0) * f.damping_n_s_per_m + std::sqrt(3.0) * f.limit_n;
}

double display_rule(const Preset& preset) {
  const Method method = preset.solver.method;
  const TactileSource source = preset.display.source;
  if (source == TactileSource::smooth || (source == TactileSource::method && is_smooth(method))) return 0.0;
  return 1.0 + static_cast<double>(source) + 8.0 * static_cast<double>(method) + 1e3 * preset.display.travel_m +
         1e3 * std::sqrt(2.0) * preset.display.finger_arc_m;
}

/// How far to go from `old` to `decided`, 0 to 1, so that the force is at most `most` from the last one. That holds for
/// `old` itself, or nothing does.
double share_within(const Vec3& last, const Vec3& old, const Vec3& decided, double most) {
  const Vec3 off = old - last, way = decided - old;
  const double a = glm::dot(way, way), b = glm::dot(off, way), c = glm::dot(off, off) - most * most;
  if (a == 0.0) return 1.0;
  const double root2 = b * b - a * c;
  if (!(root2 > 0.0)) return 0.0;
  return std::clamp((std::sqrt(root2) - b) / a, 0.0, 1.0);
}

/// `fades` of the last tick in, of this one out.
bool limits(double rule, double last_rule, bool on, std::uint8_t& fades) {
  fades = fades || rule != last_rule;
  return on && (rule == 0.0 || fades);
}

/// Where the display is to go: to the contact, unless it is off the pad or has only just come to another place.
double display_target(const Rendered& decided, bool switched, double dt_s, RenderedState& state) {
  state.display_waits_s = switched ? kDisplayWait : std::max(0.0, state.display_waits_s - dt_s);
  return decided.off_pad || state.display_waits_s > 0.0 ? state.cld_m : decided.cld_m;
}

}  // namespace

void begin_change(RenderedState& state) {
  state.change_s = 0.0;
  state.changes = state.force_fades = state.display_fades = 1;
}

bool holds_off_pad(const Preset& preset) {
  return preset.force.blend == ForceBlend::events && display_rule(preset) == 0.0;
}

double most_force_change_n(const Preset& preset, const FingerWay& way) {
  return kForceFade * way.dt_s + 2.0 * preset.force.stiffness_n_per_m * std::sqrt(glm::dot(way.moved, way.moved));
}

double most_display_change_m(const Preset& preset, const FingerWay& way) {
  const DisplaySettings& d = preset.display;
  const double gone = std::sqrt(glm::dot(way.moved, way.moved));
  return kDisplayFade * d.travel_m * way.dt_s + 2.0 * d.travel_m / d.finger_arc_m * gone;
}

namespace {

bool is_changing(const RenderedState& last, std::uint8_t fades) { return last.changes && fades; }

/// After a change of preset or scene. The old plane is as stiff as the stiffer of the two presets, so that a finger
/// that leaves it is free of it as soon as it was.
void blend_change(const FingerWay& way, const Vec3& decided, const RenderedState& last, RenderedState& state,
                  Vec3& force) {
  state.stiffness_n_per_m = std::max(state.stiffness_n_per_m, last.stiffness_n_per_m);
  const Vec3 old = left_of_last(last.force_n, way.moved, state.stiffness_n_per_m), change = decided - old;
  const double length = std::sqrt(glm::dot(change, change)),
               most = kForceFade * (1.0 + state.change_s / kChangeFade) * way.dt_s;
  if (length <= most) {
    state.force_fades = 0;
    return;
  }
  force = old + most / length * change;
}

void blend_force(const Preset& preset, const FingerWay& way, const Vec3& decided, const RenderedState& last,
                 RenderedState& state, Vec3& force) {
  const double stiffness = preset.force.stiffness_n_per_m;
  const double most = most_force_change_n(preset, way);
  const Vec3 change = decided - last.force_n;
  if (glm::dot(change, change) <= most * most) {
    state.force_fades = 0;
    return;
  }
  const Vec3 old = left_of_last(last.force_n, way.moved, stiffness);
  force = old + share_within(last.force_n, old, decided, most) * (decided - old);
}

void blend_display(const Preset& preset, const FingerWay& way, const Rendered& decided, bool switched,
                   const RenderedState& last, RenderedState& state, double& cld_m) {
  const DisplaySettings& d = preset.display;
  const double half = 0.5 * d.travel_m, most = most_display_change_m(preset, way);
  const double target = state.display_rule == 0.0 ? display_target(decided, switched, way.dt_s, state) : decided.cld_m;
  cld_m = std::clamp(std::clamp(target, last.cld_m - most, last.cld_m + most), -half, half);
  if (cld_m == decided.cld_m) state.display_fades = 0;
}

}  // namespace

Rendered blend(const Preset& preset, const FingerWay& way, const Rendered& decided, bool switched,
               RenderedState& state) {
  const RenderedState last = state;
  state.force_rule = force_rule(preset);
  state.display_rule = display_rule(preset);
  Rendered out = decided;
  state.stiffness_n_per_m = preset.force.stiffness_n_per_m;
  state.change_s = last.change_s + way.dt_s;
  if (last.has && !decided.ramps_out) {
    const bool on = preset.force.blend == ForceBlend::events;
    const bool force_changes = is_changing(last, last.force_fades),
               display_changes = is_changing(last, last.display_fades);
    if (force_changes)
      blend_change(way, decided.force_n, last, state, out.force_n);
    else if (limits(state.force_rule, last.force_rule, on, state.force_fades))
      blend_force(preset, way, decided.force_n, last, state, out.force_n);
    if (limits(state.display_rule, last.display_rule, on || display_changes, state.display_fades))
      blend_display(preset, way, decided, switched, last, state, out.cld_m);
  }
  if (out.force_n != decided.force_n) limit_force(preset, out.force_n);
  state.changes = last.has && last.changes && (state.force_fades || state.display_fades);
  state.force_n = out.force_n;
  state.cld_m = out.cld_m;
  state.has = 1;
  return out;
}

}  // namespace tangent
