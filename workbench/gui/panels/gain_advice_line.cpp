// The lines under the solver's gains: what they leave at the tick in view and take over the chosen ticks, and gains
// that do better by those numbers, or that none were found.
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
      "The share of the error that an iteration leaves at this contact, in the worst direction. Along a principal "
      "direction of curvature k a unit step leaves h k of the error, h being the height of the finger's centre. The "
      "ideal factor is 1/(1 + h k), and Eq. 1 gives it with G_o = 1, G_k = h, G_d = 0; h is about the finger's radius.";
  text +=
      printed("\n\nHere: h = %.1f mm, principal curvatures %.3g and %.3g 1/m, so the factors should be %s and %s.",
              a.height_m * 1e3, a.k1_per_m, a.k2_per_m, factor_text(a.ideal1).c_str(), factor_text(a.ideal2).c_str());
  if (a.k2_per_m < -1e-3 * std::abs(a.k1_per_m))
    text += " Where the surface is concave they are above 1, which needs a G_o above 1.";
  else if (a.ideal2 > 1.5 * a.ideal1)
    text += " One gain has to serve both, which costs iterations when moving obliquely.";
  return text;
}

std::string gains_text(const Gains& gains) {
  const auto value = [](const char* key, double v) { return display_with_unit(*find_preset_key("solver", key), v); };
  return "G_o " + value("gain_overall", gains.overall) + "  G_k " + value("gain_curvature_m", gains.curvature_m) +
         "  G_d " + value("gain_distance_per_m", gains.distance_per_m);
}

/// A line, and under it what is advised, with a button that takes it. True: pressed.
bool advice_lines(const UiContext& ui, const char* path, const std::string& line, ImU32 ink, const std::string& advice,
                  std::string_view doc) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(9));
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::PushTextWrapPos();
  ImGui::TextUnformatted(line.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ui.items.note_last(path);
  tooltip(ui, doc);
  bool set = false;
  if (!advice.empty()) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(9));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(advice.c_str());
    ImGui::SameLine(0, ui.px(8));
    set = text_button(ui, std::string(path) + "/set", "Set", "G_o, G_k and G_d take these values, as one step of undo");
  }
  ImGui::PopFont();
  return set;
}

std::string percent(double share) { return std::isfinite(share) ? printed("%.0f %%", 100.0 * share) : "all or more"; }

void draw_here(const UiContext& ui, AppModel& model) {
  const auto advice = model.tuning().advice_here();
  if (!advice) {
    advice_lines(ui, "solver/advice", "No contact on a face in view to advise on", ui.colours.text_faint, "",
                 "What an iteration leaves of the error is known at a contact on a face");
    return;
  }
  const bool slow = !(advice->left_now < 1.0);
  std::string line = "At this tick an iteration leaves " + percent(advice->left_now) + " of the error";
  if (!advice->better()) {
    line += model.time().paused() ? "; no gains leave less" : "";
    advice_lines(ui, "solver/advice", line, slow ? ui.colours.warning : ui.colours.text_dim, "", reason(*advice));
    return;
  }
  line += "; " + percent(advice->left_advised) + " with";
  if (advice_lines(ui, "solver/advice", line, slow ? ui.colours.warning : ui.colours.text, gains_text(advice->advised),
                   reason(*advice)))
    model.tuning().set_gains(advice->advised);
}

std::string score_text(const RunScore& score) {
  return printed("%.2f iterations per tick", score.mean_iterations()) +
         (score.unconverged > 0 ? printed(", %llu failed", static_cast<unsigned long long>(score.unconverged)) : "");
}

void draw_found(const UiContext& ui, AppModel& model, const GainSearchResult& found) {
  const Gains now = gains_of(model.presets().current().solver);
  const bool at_best = now == found.best.gains;
  const std::string ticks = printed("Ticks %llu to %llu: ", static_cast<unsigned long long>(found.first_tick),
                                    static_cast<unsigned long long>(found.last_tick));
  const std::string doc = printed(
      "Gains tuned on the poses of these ticks, as the command tune does, from the overall, curvature and "
      "distance gains together. p99 %d iterations now, %d with those found",
      found.now.p99_iterations, found.best.score.p99_iterations);
  if (at_best || !shows_better(found.now, found.best.score)) {
    const RunScore& score = at_best ? found.best.score : found.now;
    advice_lines(ui, "solver/advice_range", ticks + score_text(score) + "; no gains found do better",
                 ui.colours.text_dim, "", doc);
    return;
  }
  if (advice_lines(ui, "solver/advice_range",
                   ticks + score_text(found.now) + "; " + score_text(found.best.score) + " with", ui.colours.text,
                   gains_text(found.best.gains), doc))
    model.tuning().set_gains(found.best.gains);
}

void draw_range(const UiContext& ui, AppModel& model) {
  TuningModel& tuning = model.tuning();
  if (const auto found = tuning.found()) draw_found(ui, model, *found);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(9));
  if (tuning.search().running()) {
    if (text_button(ui, "solver/advice/cancel", "Cancel", "Stops the search")) tuning.search().cancel();
    ImGui::SameLine();
    ImGui::TextDisabled("searching gains, %.0f %%", std::min(100.0, 100.0 * tuning.search().progress()));
    return;
  }
  const char* label =
      model.time().selection_solvable() ? "Search gains on A to B" : "Search gains on the recorded ticks";
  if (text_button(ui, "solver/advice/search", label,
                  "Solves the newest 4,000 of these ticks with hundreds of gains, in the background"))
    tuning.search_gains();
}

}  // namespace

void draw_gain_advice(const UiContext& ui, AppModel& model) {
  const Preset& preset = model.presets().current();
  // The 2D iteration has no gains, nor have the other methods.
  if (model.scene().current() == nullptr || model.scene().current()->planar() != nullptr ||
      preset.solver.method != Method::paper)
    return;
  draw_here(ui, model);
  draw_range(ui, model);
  ImGui::Dummy({1, ui.px(2)});
}

}  // namespace tangent
