#include "workbench/gui/platform/key_taps.h"

#include <algorithm>
#include <utility>

namespace tangent {

void KeyTaps::apply(ImGuiIO& io, KeyModifiers down) {
  const std::vector<int> let_go = std::exchange(held_, {});
  for (const int key : let_go) io.KeysDown[key] = false;
  if (!let_go.empty()) {
    io.KeyCtrl = down.ctrl;
    io.KeyShift = down.shift;
    io.KeyAlt = down.alt;
  }
  const auto among = [](const std::vector<int>& keys, int key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  std::vector<Tap> later;
  for (const Tap& tap : pressed_) {
    if (tap.key < 0 || tap.key >= IM_ARRAYSIZE(io.KeysDown)) continue;
    // Between two taps ImGui has to see the key up for a frame.
    if (among(held_, tap.key) || among(let_go, tap.key)) {
      later.push_back(tap);
      continue;
    }
    if (io.KeysDown[tap.key]) continue;
    io.KeysDown[tap.key] = true;
    io.KeyCtrl |= tap.with.ctrl;
    io.KeyShift |= tap.with.shift;
    io.KeyAlt |= tap.with.alt;
    held_.push_back(tap.key);
  }
  pressed_ = std::move(later);
}

}  // namespace tangent
