// Every text that a frame draws, widgets' labels and what panels, plots and the view write alike: where it is, what it
// is clipped to, in which colour, on which ground. The test program's linker hands all of ImGui's AddText over
// (--wrap, see tests/CMakeLists.txt).
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace tangent::test {

struct DrawnText {
  std::string text;
  ImVec2 min, max;            ///< the whole text, on the screen
  ImVec2 clip_min, clip_max;  ///< what of the screen it is clipped to
  ImU32 ink = 0;
  const ImDrawList* list = nullptr;
  int first_vertex = 0, end_vertex = 0;  ///< of the list
  float line = 0.0f;                     ///< height of one line

  bool in_view() const { return first_vertex < end_vertex; }
  float cut_right() const { return max.x - clip_max.x; }
  float cut_left() const { return clip_min.x - min.x; }
};

/// While it lives, what is drawn is recorded. One at a time.
class TextRecorder {
 public:
  TextRecorder();
  ~TextRecorder();
  TextRecorder(const TextRecorder&) = delete;
  TextRecorder& operator=(const TextRecorder&) = delete;

  void clear() { texts_.clear(); }
  /// Since `clear`, in the order of drawing; a halo and its text are one.
  std::vector<DrawnText> texts() const;
  void add(DrawnText text) { texts_.push_back(std::move(text)); }

 private:
  std::vector<DrawnText> texts_;
};

/// Whether letters of both are on the same place of the screen.
bool collide(const DrawnText& a, const DrawnText& b);

/// Contrast after WCAG 2.1 of each text with what was drawn under it, the worst of some of its places. For the frame
/// drawn last. `cleared`: what the frame is drawn on.
std::vector<double> contrasts(const std::vector<DrawnText>& texts, const ImVec4& cleared);

}  // namespace tangent::test
