// The operator's screen: state of device and gate, the force of the last seconds, where the experiment is, what is felt
// now and what comes then, notes, faults with what to do, and a button that stops the force, always in reach.
#pragma once

#include "workbench/gui/experiment/screens.h"
#include "workbench/gui/widgets/ui_context.h"

#include <imgui.h>

#include <map>
#include <string>
#include <vector>

namespace tangent {

class OperatorPanel {
 public:
  /// Sets fonts and style of the current ImGui context. True when the font atlas was rebuilt.
  bool prepare(Theme theme, float scale);
  /// ImGui::NewFrame, the whole screen, ImGui::Render. Escape stops before anything else is looked at.
  OperatorWishes frame(const OperatorScreen& screen, ImVec2 size, double now_s);

  /// Covers what the participant must not read: on at first where both screens are on one monitor.
  void set_covered(bool covered) { covered_ = covered; }
  bool covered() const { return covered_; }
  const ItemMap& items() const { return items_; }
  ImVec4 ground() const;

 private:
  void draw_bar(const UiContext& ui, const OperatorScreen& screen, float width, OperatorWishes& wishes);
  void draw_device(const UiContext& ui, const OperatorScreen& screen, const OperatorWishes& wishes);
  void draw_now(const UiContext& ui, const OperatorScreen& screen, OperatorWishes& wishes);
  void draw_notes(const UiContext& ui, const OperatorScreen& screen, OperatorWishes& wishes);
  void draw_plots(const UiContext& ui, const OperatorScreen& screen, ImVec2 at, ImVec2 size);

  ItemMap items_;
  Typing typing_;
  Resting resting_;
  ThemeFonts fonts_;
  std::map<std::string, bool> open_sections_;
  Theme theme_ = Theme::dark;
  float scale_ = 0.0f;
  bool covered_ = false, ending_ = false;
  std::string note_;
};

}  // namespace tangent
