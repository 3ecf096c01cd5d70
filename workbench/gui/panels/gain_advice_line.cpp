// The line under the solver's gains with the recommended values at this contact, and the reason.
#include "core/lab/gains/gain_advice.h"

#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <cmath>

namespace tangent {

namespace {

std::string factor_text(double factor) {
  return factor > 0.0 && std::isfinite(factor) ? printed("%.2f", factor) : "none";
}

std::string reason(const GainAdvice& a) {
  std::string text =
      "Along a principal direction of curvature k a unit step leaves h k of the error, h being the height of the "
      "finger's "
      "centre. The ideal factor is 1/(1 + h k), and Eq. 1 gives it with G_o = 1, G_k = h, G_d = 0; h is about the "
      "finger's radius.";
  if (!a.local) return text + "\n\nThere is no contact on a face in view to be more exact about.";
  text +=
      printed("\n\nHere: h = %.1f mm, principal curvatures %.3g and %.3g 1/m, so the factors should be %s and %s.",
              a.height_m * 1e3, a.k1_per_m, a.k2_per_m, factor_text(a.ideal1).c_str(), factor_text(a.ideal2).c_str());
  if (a.k2_per_m < -1e-3 * std::abs(a.k1_per_m))
    text += " On concave ground they are above 1, which Eq. 1 can't give with G_o = 1.";
  else if (a.ideal2 > 1.5 * a.ideal1)
    text += " One gain has to serve both, which costs iterations when moving obliquely.";
  return text;
}

}  // namespace

void draw_gain_advice(const UiContext& ui, AppModel& model) {
  const Preset& preset = model.presets().current();
  // The 2D iteration has no gains.
  if (model.scene().current() == nullptr || model.scene().current()->planar() != nullptr ||
      preset.solver.method != Method::paper)
    return;
  std::optional<TickOutput> contact;
  const ServoRecord* record = model.time().tick().record();
  if (record != nullptr && record->tick.output.triangle < model.scene().current()->mesh().triangle_count())
    contact = record->tick.output;
  const GainAdvice advice = advise_gains(model.scene().current()->mesh(), preset, contact);
  const PresetKey& key = *find_preset_key("solver", "gain_curvature_m");
  const float button = ImGui::CalcTextSize("Set").x + 2.0f * ImGui::GetStyle().FramePadding.x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small;
  const std::string line = "Advice: G_k near " + display_with_unit(key, advice.gain_curvature_m);
  std::string effect = "the finger's radius";
  if (advice.local)
    effect = printed("a plane leaves %.0f %% here; %.0f %% now", 100.0 * advice.left_advised, 100.0 * advice.left_now);
  const float line_height = font->FontSize + ui.px(2);
  ImGui::InvisibleButton("##advice", {width - button - ui.px(8), 2.0f * line_height});
  ui.items.note_last("solver/advice");
  tooltip(ui, reason(advice));
  draw.AddText(font, font->FontSize, {at.x + ui.px(9), at.y}, ui.colours.text, line.c_str());
  draw.AddText(font, font->FontSize, {at.x + ui.px(9), at.y + line_height},
               advice.local && advice.left_now >= 1.0 ? ui.colours.warning : ui.colours.text_dim, effect.c_str());
  ImGui::SetCursorScreenPos({at.x + width - button, at.y + ui.px(2)});
  if (text_button(ui, "solver/advice/set", "Set", "G_k takes the advised value; G_o and G_d stay"))
    model.presets().set_value(key, advice.gain_curvature_m);
  ImGui::SetCursorScreenPos({at.x, at.y + 2.0f * line_height + ui.px(5)});
  ImGui::Dummy({1, 1});
}

}  // namespace tangent
