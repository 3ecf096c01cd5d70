// Keys that go down and up between two frames. ImGui 1.86 has no event queue: it looks at which keys are down when a
// frame begins, so a quick tap during a slow frame would be lost. Here such a key stays down for the one frame, and the next tap
// of the same key waits until it was seen up.
#pragma once

#include <imgui.h>

#include <vector>

namespace tangent {

struct KeyModifiers {
  bool ctrl = false, shift = false, alt = false;
};

class KeyTaps {
 public:
  /// A key went down, with these modifiers, as the window system reports it.
  void pressed(int key, KeyModifiers with) { pressed_.push_back({key, with}); }
  /// Before ImGui::NewFrame, after the back end wrote `io`. `down`: the modifiers that are down now.
  void apply(ImGuiIO& io, KeyModifiers down);
  bool waiting() const { return !pressed_.empty(); }  ///< a tap is left for the next frame

 private:
  struct Tap {
    int key;
    KeyModifiers with;
  };
  std::vector<Tap> pressed_;
  std::vector<int> held_;  ///< kept down for the last frame
};

}  // namespace tangent
