// Keys of the participant's window: Enter, 1 to 9 (also of the number pad), Escape; Space raises a simulated finger.
#pragma once

#include "workbench/experiment/protocol.h"
#include "workbench/experiment/shown.h"
#include "workbench/gui/experiment/screens.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tangent {

struct PressedKey {
  enum class Kind : std::uint8_t { enter, digit, stop, lift };
  Kind kind = Kind::enter;
  int digit = 0;  ///< 1 to 9
  bool operator==(const PressedKey&) const = default;
};

/// Of a GLFW key code; none: the experiment has no use for it.
std::optional<PressedKey> experiment_key(int glfw_key);

/// What may be pressed in this phase, for the participant's screen. `choice`: pressed and not yet given, 1 or 2.
std::vector<ScreenKey> keys_to_press(const experiment::Protocol& protocol, experiment::Phase phase, int choice);

}  // namespace tangent
