#include "workbench/gui/platform/key_taps.h"

namespace tangent {

void KeyTaps::apply(ImGuiIO& io, KeyModifiers down) {
  if (!held_.empty()) {
    for (const int key : held_) io.KeysDown[key] = false;
    held_.clear();
    io.KeyCtrl = down.ctrl;
    io.KeyShift = down.shift;
    io.KeyAlt = down.alt;
  }
  for (const Tap& tap : pressed_) {
    if (tap.key < 0 || tap.key >= IM_ARRAYSIZE(io.KeysDown) || io.KeysDown[tap.key]) continue;
    io.KeysDown[tap.key] = true;
    io.KeyCtrl |= tap.with.ctrl;
    io.KeyShift |= tap.with.shift;
    io.KeyAlt |= tap.with.alt;
    held_.push_back(tap.key);
  }
  pressed_.clear();
}

}  // namespace tangent
