// What an earlier run left that ended without being closed: to take up, or to discard.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/strip.h"

#include <array>

namespace tangent {

void draw_unsaved_offer(const UiContext& ui, UnsavedModel& unsaved, const Rect& over) {
  constexpr std::array<StripButton, 2> kAnswers{
      {{"unsaved/take_up", "Restore",
        "Both presets with their undo steps, the bookmarks, and the recording at its place. Nothing is armed by it"},
       {"unsaved/discard", "Discard", "Deletes it"}}};
  const std::string text = unsaved.offer();
  if (text.empty()) return;
  const auto answer = draw_strip(ui, "##unsaved", over, StripPlace::upper_edge, text, kAnswers);
  if (answer == 0u) unsaved.take_up();
  if (answer == 1u) unsaved.discard();
}

}  // namespace tangent
