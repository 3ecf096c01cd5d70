// Guarded live tuning: the question about a change that is not known to be safe, over the scene, which stays in sight;
// and what is swept, in the section Devices.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/strip.h"
#include "workbench/gui/widgets/widgets.h"

#include <array>

namespace tangent {

void draw_guard_question(const UiContext& ui, AppModel& model, const Rect& over) {
  const auto& question = model.guard().question();
  if (!question) return;
  constexpr std::array<StripButton, 2> kAnswers{
      {{"guard/no", "No (Enter)", "The devices keep the values they have, and so does the panel"},
       {"guard/yes", "Yes, send it", "Sends it all the same. What makes the safety gate act is taken back at once"}}};
  const std::string text = question->what + " " + question->why + ". Send it to the armed device?";
  const auto pressed = draw_strip(ui, "##guard", over, StripPlace::lower_edge, text, kAnswers);
  if (pressed) model.guard().answer(*pressed == 1);
}

bool refuse_by_enter(GuardModel& guard) {
  if (!guard.question() || text_is_edited()) return false;
  if (!ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)) return false;
  guard.answer(false);
  return true;
}

void draw_guard(const UiContext& ui, GuardModel& guard) {
  toggle_button(ui, "guard/on", "Guard", guard.on,
                "While a device is armed, a change that is not known to be stable in the simulated hand is asked about "
                "first, and one that makes the safety gate act is taken back at once. A simulated device is guarded "
                "when its safe ranges were found");
  ImGui::SameLine();
  if (guard.finding()) {
    if (text_button(ui, "guard/cancel", "Cancel", "Stops and keeps what is known")) guard.cancel();
    ImGui::SameLine();
    ImGui::TextDisabled("%zu of %zu", guard.sweep().done_lines(), guard.sweep().lines());
  } else if (text_button(ui, "guard/find", "Find safe ranges",
                         "Tries every value in the simulated hand, at several places of this mesh and in three grips, "
                         "in the background: a line under a slider is stable, teeth shake, dots are not known. "
                         "After a change they are found again")) {
    guard.find_ranges();
  }
}

}  // namespace tangent
