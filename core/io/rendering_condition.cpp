#include "core/io/rendering_condition.h"

#include <algorithm>
#include <string>

namespace tangent {

void set_condition(Preset& preset, const RenderingCondition& condition) {
  preset.force.source = condition.force;
  preset.display.source = condition.tactile;
}

const RenderingCondition* condition_of(const Preset& preset) {
  const auto found =
      std::find_if(kRenderingConditions.begin(), kRenderingConditions.end(), [&](const RenderingCondition& c) {
        return c.force == preset.force.source && c.tactile == preset.display.source;
      });
  return found == kRenderingConditions.end() ? nullptr : &*found;
}

const RenderingCondition* find_condition(std::string_view name) {
  const auto found = std::find_if(kRenderingConditions.begin(), kRenderingConditions.end(),
                                  [&](const RenderingCondition& c) { return c.name == name; });
  return found == kRenderingConditions.end() ? nullptr : &*found;
}

const RenderingCondition& object_condition(bool shaded, bool tactile) {
  return kRenderingConditions[kArcConditions + (tactile ? 2 : 0) + (shaded ? 1 : 0)];
}

Status check_devices(const Preset& preset, bool has_force_device, bool has_display) {
  const RenderingCondition* condition = condition_of(preset);
  const std::string who = condition ? "condition " + std::string(condition->name) : "this preset";
  if ((preset.display.source == TactileSource::facet || preset.display.source == TactileSource::smooth) && !has_display)
    return fail(who + " needs a contact location display, and there is none", "display.source",
                "choose C1, C2 or force-shaded (tactile held), or devices with a display");
  if (condition && !has_force_device)
    return fail(who + " needs a force device, and there is none", "force.source", "choose devices that render force");
  return {};
}

}  // namespace tangent
