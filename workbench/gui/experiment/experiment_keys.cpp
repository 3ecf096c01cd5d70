#include "workbench/gui/experiment/experiment_keys.h"

#include <string>

namespace tangent {
namespace {

// GLFW's codes, so that this needs no GLFW.
constexpr int kSpaceKey = 32, kEscapeKey = 256, kEnterKey = 257, kPadEnterKey = 335, kPadZeroKey = 320;

}  // namespace

std::optional<PressedKey> experiment_key(int glfw_key) {
  if (glfw_key == kEscapeKey) return PressedKey{PressedKey::Kind::stop, 0};
  if (glfw_key == kSpaceKey) return PressedKey{PressedKey::Kind::lift, 0};
  if (glfw_key == kEnterKey || glfw_key == kPadEnterKey) return PressedKey{PressedKey::Kind::enter, 0};
  if (glfw_key >= '1' && glfw_key <= '9') return PressedKey{PressedKey::Kind::digit, glfw_key - '0'};
  if (glfw_key > kPadZeroKey && glfw_key <= kPadZeroKey + 9)
    return PressedKey{PressedKey::Kind::digit, glfw_key - kPadZeroKey};
  return std::nullopt;
}

std::vector<ScreenKey> keys_to_press(const experiment::Protocol& protocol, experiment::Phase phase, int choice) {
  using experiment::Phase;
  switch (phase) {
    case Phase::training:
    case Phase::first:
    case Phase::rest:
      return {{"Enter", "go on", false}};
    case Phase::second:
      return {{"1", "the first", choice == 1}, {"2", "the second", choice == 2}, {"Enter", "", false}};
    case Phase::explore: {
      std::vector<ScreenKey> keys;
      if (const experiment::Identification* design = protocol.identification())
        for (const std::string& object : design->objects)
          keys.push_back({std::to_string(keys.size() + 1), object, false});
      return keys;
    }
    case Phase::guide:
    case Phase::finished:
      break;
  }
  return {};
}

}  // namespace tangent
