// The paper's rendering conditions by name: independent sources of force and of the contact display. C1 to C4, P1 and
// P2 are those of its first experiment (5.2.3); those of its second (5.3.3) are force alone or force and tactile, on
// objects with or without shading.
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"

#include <array>
#include <span>
#include <string_view>

namespace tangent {

struct RenderingCondition {
  std::string_view name;  ///< "C1"
  ForceSource force;
  TactileSource tactile;   ///< held: the display stays at its centre
  std::string_view words;  ///< "facet force, tactile held"
};

inline constexpr std::array<RenderingCondition, 10> kRenderingConditions{{
    {"C1", ForceSource::facet, TactileSource::held, "facet force, tactile held"},
    {"C2", ForceSource::force_shading, TactileSource::held, "force shading, tactile held"},
    {"C3", ForceSource::facet, TactileSource::facet, "facet force, facet tactile"},
    {"C4", ForceSource::facet, TactileSource::smooth, "facet force, smooth tactile"},
    {"P1", ForceSource::smooth, TactileSource::smooth, "force and tactile smooth"},
    {"P2", ForceSource::force_shading, TactileSource::facet, "force shading, facet tactile"},
    {"force-unshaded", ForceSource::facet, TactileSource::held, "object, facet force, tactile held (as C1)"},
    {"force-shaded", ForceSource::smooth, TactileSource::held, "object, smooth force, tactile held"},
    {"tactile-unshaded", ForceSource::facet, TactileSource::facet, "object, facet force and tactile (as C3)"},
    {"tactile-shaded", ForceSource::smooth, TactileSource::smooth, "object, smooth force and tactile (as P1)"},
}};
/// The names, in the same order.
inline constexpr std::array<std::string_view, 10> kConditionNames{
    "C1", "C2", "C3", "C4", "P1", "P2", "force-unshaded", "force-shaded", "tactile-unshaded", "tactile-shaded"};
/// The first ones: those of arcs, for which there are thresholds (core/lab/measure/perception_thresholds.h).
inline constexpr std::size_t kArcConditions = 6;
inline constexpr std::array<std::string_view, kArcConditions> kArcConditionNames{"C1", "C2", "C3", "C4", "P1", "P2"};

inline std::span<const RenderingCondition> arc_conditions() {
  return std::span(kRenderingConditions).first<kArcConditions>();
}

void set_condition(Preset& preset, const RenderingCondition& condition);
/// The first condition that matches a preset's sources; null: none of them.
const RenderingCondition* condition_of(const Preset& preset);
const RenderingCondition* find_condition(std::string_view name);
/// Of the second experiment. `tactile`: with force and tactile feedback, else force alone.
const RenderingCondition& object_condition(bool shaded, bool tactile);

/// Whether the devices present can render the preset: a tactile source of facet or smooth needs a contact location
/// display, an explicit force source a force device. The source `method` works with any devices. Fails naming what is
/// missing.
Status check_devices(const Preset& preset, bool has_force_device, bool has_display);

}  // namespace tangent
