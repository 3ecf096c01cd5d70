// While there is no force: why, and the control that arms. Red where a fault ended the force, with the fault in words.
// Far from the stop button, so that neither is hit for the other.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/strip.h"

#include <array>

namespace tangent {

void draw_arming_bar(const UiContext& ui, DeviceModel& devices, const Rect& over) {
  const std::array<StripButton, 1> arm{{{"arming/arm", devices.faulted() ? "Clear fault and arm" : "Arm",
                                         "One attempt: clears faults, homes what is not homed, waits up to 5 s "
                                         "until the force would be below 0.2 N, and "
                                         "ramps the force in over a quarter of a second",
                                         devices.faulted()}}};
  const std::string text = devices.arming_text();
  if (!text.empty() && draw_strip(ui, "##arming", over, StripPlace::lower_edge, text, arm)) devices.arm();
}

}  // namespace tangent
