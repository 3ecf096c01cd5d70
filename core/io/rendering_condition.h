// The paper's rendering conditions by name: independent sources of force and of the contact display.
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"

#include <array>
#include <string_view>

namespace tangent {

struct RenderingCondition {
  std::string_view name;  ///< "C1"
  ForceSource force;
  TactileSource tactile;   ///< held: the display stays at its centre
  std::string_view words;  ///< "facet force, tactile held"
};

inline constexpr std::array<RenderingCondition, 6> kRenderingConditions{{
    {"C1", ForceSource::facet, TactileSource::held, "facet force, tactile held"},
    {"C2", ForceSource::force_shading, TactileSource::held, "force shading, tactile held"},
    {"C3", ForceSource::facet, TactileSource::facet, "facet force, facet tactile"},
    {"C4", ForceSource::facet, TactileSource::smooth, "facet force, smooth tactile"},
    {"P1", ForceSource::smooth, TactileSource::smooth, "force and tactile smooth"},
    {"P2", ForceSource::force_shading, TactileSource::facet, "force shading, facet tactile"},
}};
/// The names, in the same order.
inline constexpr std::array<std::string_view, 6> kConditionNames{"C1", "C2", "C3", "C4", "P1", "P2"};

void set_condition(Preset& preset, const RenderingCondition& condition);
/// The condition that matches a preset's sources; null: none of the six.
const RenderingCondition* condition_of(const Preset& preset);
const RenderingCondition* find_condition(std::string_view name);

/// Whether the devices present can render the preset: a tactile source of facet or smooth needs a contact location
/// display, an explicit force source a force device. The source `method` works with any devices. Fails naming what is
/// missing.
Status check_devices(const Preset& preset, bool has_force_device, bool has_display);

}  // namespace tangent
