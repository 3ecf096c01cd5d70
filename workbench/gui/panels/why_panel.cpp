// Why the tick in view did what it did: the cause, what decided it, the cure, and where on the mesh it is.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <cmath>
#include <string_view>

namespace tangent {

namespace {

std::string decided_number(double value, std::string_view unit) {
  if (unit == "m")
    return std::abs(value) < 1e-4 ? printed("%.4g \u00b5m", 1e6 * value) : printed("%.4g mm", 1e3 * value);
  if (unit == "s") return printed("%.4g ms", 1e3 * value);
  return printed("%.4g", value) + (unit == "1" || unit.empty() ? "" : " " + std::string(unit));
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

void small_text(const UiContext& ui, const std::string& text, ImU32 ink) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

std::string proof_text(const TickOutput& proof) {
  return printed("%s, %d plane%s", to_string(proof.status), proof.iterations, proof.iterations == 1 ? "" : "s");
}

void draw_cause(const UiContext& ui, const TickExplanation& told) {
  const bool fine = told.cause == TickCause::nothing || told.cause == TickCause::first_contact;
  const ImU32 ink = fine ? ui.colours.good : told.cause == TickCause::not_told ? ui.colours.text : ui.colours.warning;
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::TextWrapped("%s", sentence_of(told));
  ImGui::PopStyleColor();
  ui.items.note_last("why/cause");
  tooltip(ui,
          "Found by solving the tick again, and with one thing changed at a time; not told where nothing proves it");
}

void draw_decided(const UiContext& ui, const DecidingNumber& decided) {
  if (decided.what == nullptr) return;
  small_text(ui, capital(decided.what) + " " + decided_number(decided.value, decided.unit), ui.colours.text);
  ui.items.note_last("why/decided");
  small_text(ui,
             capital(decided.against) + " " + decided_number(decided.threshold, decided.unit) + ", " +
                 decided_number(std::abs(decided.margin()), decided.unit) +
                 (decided.margin() < 0.0 ? " less" : " more"),
             ui.colours.text_dim);
}

void draw_cure(const UiContext& ui, WhyModel& why, const TickCure& cure) {
  if (cure.outcome == CureOutcome::not_sought) return;
  if (cure.outcome == CureOutcome::none_in_range)
    return small_text(ui, "No value of a parameter that has to do with it cures it within its range",
                      ui.colours.text_dim);
  const std::string change =
      display_with_unit(*cure.key, cure.from) + " \u2192 " + display_with_unit(*cure.key, cure.to);
  small_text(ui, std::string(cure.key->label) + "  " + change + (cure.as_deep ? ", as deep" : ""), ui.colours.text);
  ui.items.note_last("why/cure");
  tooltip(ui, "The smallest change of one value after which the tick needs no explaining, proved by solving it again");
  small_text(ui, "then " + proof_text(cure.proof), ui.colours.text_dim);
  if (why.can_try()) {
    if (text_button(ui, "why/try", "Try it",
                    "Solves the recorded ticks with this value beside the one they had; the preset stays as it is"))
      why.try_cure();
    ImGui::SameLine(0, ui.px(3));
  }
  if (text_button(ui, "why/set", "Set", "The preset takes this value, as one step of undo")) why.set_cure();
}

void draw_place(const UiContext& ui, WhyModel& why, const TickExplanation& told) {
  const MeshPlace& at = told.mesh;
  if (at.triangle == kNone) return;
  std::string text = printed(at.planar ? "Vertex %u" : "Triangle %u", at.triangle);
  const bool of_edge = told.cause == TickCause::crease || told.cause == TickCause::boundary;
  if (of_edge && !at.planar) text += printed(", edge %u", at.side);
  if (told.cause == TickCause::wild_normal) text += printed(", corner %u", at.side);
  text += printed(" at %.4g, %.4g, %.4g mm", 1e3 * at.place.x, 1e3 * at.place.y, 1e3 * at.place.z);
  small_text(ui, text, ui.colours.text);
  ui.items.note_last("why/place");
  if (at.mended)
    small_text(
        ui,
        std::string(told.cause == TickCause::unready ? "once built: " : "without the defect: ") + proof_text(at.proof),
        ui.colours.text_dim);
  if (why.can_go() && text_button(ui, "why/go", "Go there", "Turns the camera to the place and picks its triangle"))
    why.go_to_place();
}

}  // namespace

void draw_why_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Why this tick", state.open)) return;
  WhyModel& why = model.why();
  const Why* known = why.of_tick_in_view();
  if (known == nullptr) {
    small_text(ui,
               why.looking() ? "Looking for the cause ..."
                             : "Pause (Space) on a tick to see why it did what it did, and what cures it",
               ui.colours.text_dim);
    ImGui::Dummy({1, ui.px(3)});
    return;
  }
  draw_cause(ui, known->told);
  draw_decided(ui, known->told.decided);
  draw_cure(ui, why, known->told.cure);
  draw_place(ui, why, known->told);
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
