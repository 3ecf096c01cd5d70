// Queue of input events between two frames. ImGui 1.86 has no event queue: it samples keys, buttons and pointer when a
// frame begins, so in a slow frame a quick tap, a second tap of the same key, or a click followed by a move would be
// lost or misplaced. Here events wait until a frame can show each of them.
#pragma once

#include <imgui.h>

#include <array>
#include <cfloat>
#include <deque>

namespace tangent {

/// Codes of keys and buttons are GLFW's; positions are window coordinates.
class InputQueue {
 public:
  void key(int code, bool down);
  void character(unsigned int code_point);
  void button(int index, bool down);
  void position(float x, float y);
  void pointer_left();  ///< the pointer left the window; a drag continues outside
  void wheel(float x, float y);

  /// Call after the back end wrote `io` and before ImGui::NewFrame. Applies as many events as one frame can
  /// distinguish. The following wait for the next frame: a second change of a key, a press after another press or after
  /// text, a change of Ctrl, Shift or Alt after a press, a move after a click, a button after a move (a drag follows
  /// the moves of the frames in which its button is down).
  void apply(ImGuiIO& io);
  bool waiting() const { return !events_.empty(); }  ///< events are left for the next frame

 private:
  enum class Kind { key, character, button, position, wheel };
  struct Event {
    Kind kind;
    int code = 0;
    bool down = false;
    ImVec2 at{};
    bool modifier() const;
  };
  struct Shown;  ///< events already applied to this frame

  static bool fits(const Event& event, const Shown& shown, const ImGuiIO& io);
  void show(const Event& event, Shown& shown, ImGuiIO& io);

  std::deque<Event> events_;
  unsigned int held_ = 0;  ///< buttons down after all of `events_`, one bit each
  // The back end writes the latest pointer state into `io` each frame; this is the state in event order.
  ImVec2 pointer_{-FLT_MAX, -FLT_MAX};
  std::array<bool, 5> buttons_{};
};

}  // namespace tangent
