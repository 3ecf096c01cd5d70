// The page of the device monitor that brings a force device up: its steps, what is asked, and the answers.
#include "workbench/bringup/bring_up_text.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>

namespace tangent {
namespace {

ImU32 verdict_ink(const UiContext& ui, StepVerdict verdict) {
  switch (verdict) {
    case StepVerdict::proved:
      return ui.colours.good;
    case StepVerdict::failed:
      return ui.colours.bad;
    case StepVerdict::running:
      return ui.colours.accent;
    case StepVerdict::not_proved:
      return ui.colours.warning;
    default:
      return ui.colours.text_faint;
  }
}

void page_text(const std::string& text, ImU32 ink) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void draw_steps(const UiContext& ui, const BringUpModel& bring_up) {
  for (std::size_t i = 0; i < kBringUpSteps; ++i) {
    const auto step = static_cast<BringUpStep>(i);
    const StepVerdict verdict = bring_up.view().verdicts[i];
    fact(ui, step_title(step), to_string(verdict), "", verdict_ink(ui, verdict));
    if (verdict == StepVerdict::waiting) continue;
    ImGui::PushFont(ui.fonts.small);
    const std::string facts = step_facts_text(step, bring_up.view(), bring_up.capabilities());
    if (!facts.empty()) page_text(facts, ui.colours.text_dim);
    std::string why = step_why_text(step, bring_up.view(), bring_up.capabilities());
    if (verdict == StepVerdict::failed && why.empty()) why = bring_up.protocol().opening.message();
    if (!why.empty()) page_text(why, ui.colours.bad);
    ImGui::PopFont();
  }
}

void draw_answers(const UiContext& ui, BringUpModel& bring_up) {
  const BringUpView& view = bring_up.view();
  const bool settled = bring_up.settled();
  bool first = true;
  ImGui::BeginDisabled(!settled);
  const auto button = [&](const char* path, const std::string& text, const char* tip, BringUpAnswer answer) {
    if (text.empty()) return;
    if (!first) same_line_if_room(button_width(text.c_str()));
    first = false;
    if (text_button(ui, path, text.c_str(), tip)) bring_up.answer(answer);
  };
  const bool pushes = view.ask == BringUpAsk::push || view.ask == BringUpAsk::hold_on;
  button("bring_up/yes", yes_text(view, bring_up.capabilities()),
         pushes ? "For a second, then zero force" : "Then it goes on", BringUpAnswer::yes);
  button("bring_up/no", no_text(view), "Nothing moves", BringUpAnswer::no);
  if (may_skip(view)) button("bring_up/skip", "Leave it out", "The step is not proved then", BringUpAnswer::skip);
  ImGui::EndDisabled();
}

/// In a row of its own above all that grows, where it is always in view.
void draw_stop(const UiContext& ui, BringUpModel& bring_up) {
  ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.bad);
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.on_bad);
  if (text_button(ui, "bring_up/stop", "Stop", "Zero force at once, and the end (Escape)")) bring_up.stop();
  ImGui::PopStyleColor(2);
}

/// No step was left out, by the person or because the device has no such thing.
bool has_all(const BringUpView& view) {
  return std::count(view.verdicts.begin(), view.verdicts.end(), StepVerdict::not_proved) == 0;
}

void draw_question(const UiContext& ui, BringUpModel& bring_up) {
  const BringUpView& view = bring_up.view();
  if (!view.ended) draw_stop(ui, bring_up);
  ImGui::PushFont(ui.fonts.strong);
  if (view.ended)
    page_text(view.all_proved() ? has_all(view) ? "All proved." : "All that is needed was proved." : "Not all proved.",
              view.all_proved() ? ui.colours.good : ui.colours.bad);
  else
    page_text(view.asks() ? question_text(view, bring_up.capabilities()) : std::string(step_title(view.step)) + " ...",
              ui.colours.text);
  ImGui::PopFont();
  ImGui::Dummy({1, ui.px(4)});
  if (!view.ended) {
    draw_answers(ui, bring_up);
  } else if (text_button(ui, "bring_up/save", "Save protocol",
                         "Two files in the current folder, to send as evidence")) {
    bring_up.save();
  }
  ImGui::Dummy({1, ui.px(8)});
}

void draw_now(const UiContext& ui, const BringUpModel& bring_up) {
  const BringUpView& view = bring_up.view();
  const ForceCapabilities& can = bring_up.capabilities();
  fact(ui, can.name.c_str(), can.serial.empty() ? "no serial number" : can.serial);
  fact(ui, "State", to_string(view.device));
  const Vec3 p = 1e3 * view.position_m;
  fact(ui, "Position", printed("%.2f %.2f %.2f", p.x, p.y, p.z), "mm");
  fact(ui, "Force sent", printed("%.3f", glm::length(view.sent_n)), "N");
  fact(ui, "Largest that is asked for", printed("%.1f", bring_up.protocol().most_n), "N");
  ImGui::Dummy({1, ui.px(6)});
  page_text("Left open:", ui.colours.text_dim);
  for (const std::string& line : not_proved_lines(view, can)) page_text("- " + line, ui.colours.text_dim);
}

}  // namespace

void draw_bring_up_page(const UiContext& ui, BringUpModel& bring_up) {
  if (!bring_up.open()) return;
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = room > ui.px(640) ? 2 : 1;
  draw_question(ui, bring_up);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(ui.px(12), 0));
  if (ImGui::BeginTable("##bring_up", columns, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_NoPadOuterX,
                        {std::min(room, ui.px(1200)), 0})) {
    ImGui::TableNextColumn();
    draw_steps(ui, bring_up);
    ImGui::TableNextColumn();
    if (columns == 1) ImGui::Dummy({1, ui.px(8)});  // what follows is no step
    draw_now(ui, bring_up);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
}

}  // namespace tangent
