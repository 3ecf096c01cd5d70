// Tune: start and cancel, what was found so far (tune_plots.cpp, tune_table.cpp), and the trial that is tried.
#include "workbench/gui/panels/tune_parts.h"
#include "workbench/gui/plots/mark_drawing.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

namespace tangent {

namespace {

constexpr const char* kQuestion = "Tune: question";  ///< in the list of what is folded

/// Whether the question is unfolded: as a person left it; otherwise until there are trials to look at.
bool question_shown(const UiContext& ui, const TuneModel& tune) {
  const auto left = ui.open_sections.find(kQuestion);
  return left != ui.open_sections.end() ? left->second : tune.trials().empty() && !tune.running();
}

/// What is asked, in a line.
std::string question_text(const TuneQuestion& question) {
  std::string out = "Small: ";
  for (std::size_t i = 0; i < question.objectives.size(); ++i)
    out += (i > 0 ? " and " : "") + column_label(*question.objectives[i].column);
  for (std::size_t i = 0; i < question.constraints.size(); ++i)
    out += (i > 0 ? ", " : "; keep: ") + question.constraints[i].text();
  return out + printed("; %zu value%s", question.ranges.size(), question.ranges.size() == 1 ? "" : "s");
}

void draw_tune_start(const UiContext& ui, TuneModel& tune) {
  const std::size_t done = tune.trials().size();
  if (tune.running()) {
    if (text_button(ui, "tune/cancel", "Cancel", "Stops at once and keeps the trials so far")) tune.cancel();
  } else if (text_button(ui, "tune/start", "Start",
                         "Searches in the background; the front grows while you look at it")) {
    ui.open_sections.erase(kQuestion);
    tune.start();
  }
  const auto goes_on = [&ui](const char* label) { same_line_if_room(ImGui::CalcTextSize(label).x + ui.px(16)); };
  if (!tune.running() && done > 0) {
    goes_on("Clear");
    if (text_button(ui, "tune/clear", "Clear", "Forgets the trials")) tune.clear();
  }
  bool shown = question_shown(ui, tune);
  goes_on("Question");
  if (toggle_button(ui, "tune/question", "Question", shown, "What is searched for, and where"))
    ui.open_sections[kQuestion] = shown;
  const std::string count =
      tune.running() ? printed("%zu of %zu", done, tune.asked().trials) : printed("%zu trials", done);
  goes_on(count.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", count.c_str());
}

/// What the trials are of.
void draw_asked(const UiContext& ui, const TuneModel& tune) {
  const bool outdated = tune.outdated();
  draw_tune_text(ui, tune.motion_text() + (outdated ? "; other values or another mesh since" : ""),
                 outdated ? ui.colours.warning : ui.colours.text_dim);
  ui.items.note_last("tune/motion_text");
  tooltip(ui, question_text(tune.asked()));
}

/// What the plots have brushed, and where it fails.
void draw_brushed(const UiContext& ui, AppModel& model) {
  TuneModel& tune = model.tune();
  const std::string text =
      tune.brush() ? printed("%zu brushed", tune.listed().size()) : printed("%zu on the front", tune.front().size());
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text.c_str());
  if (tune.brush()) {
    same_line_if_room(ImGui::CalcTextSize("Let go").x + ui.px(16));
    if (text_button(ui, "tune/no_brush", "Let go", "Nothing is brushed; the table shows the front"))
      tune.set_brush(std::nullopt);
  }
  bool failures = tune.failures_shown();
  const char* label = "Failures on the mesh";
  same_line_if_room(ImGui::CalcTextSize(label).x + ui.px(16));
  if (toggle_button(ui, "tune/failures", label, failures,
                    "Colours the mesh by the share of the ticks at a triangle on which the trials in the table find no "
                    "contact: up to 12 of them, solved again"))
    tune.show_failures(failures);
  if (!tune.failures_shown()) return;
  if (tune.looking_for_failures()) return draw_tune_text(ui, "looking where they fail ...", ui.colours.text_dim);
  const auto paint = tune.paint(model.map().colours);
  if (!paint) return draw_tune_text(ui, "of another mesh than the one in view", ui.colours.text_dim);
  MarkLegend legend(ui);
  legend.strip("0", printed("%.3g %% of the ticks there fail", 100.0 * paint->high), paint->colours);
}

/// Asks before it writes over a preset that was there.
void save_in_use(AppModel& model, TunePanel& state) {
  if (state.name != state.asked_for && model.presets().has(state.name)) {
    state.asked_for = state.name;
    return model.messages().say(Severity::warning, "a preset \"" + state.name +
                                                       "\" is there already; press Save again to overwrite it, or type "
                                                       "another name");
  }
  if (save_tuned(model, state.name)) state.asked_for = state.name;
}

void draw_in_use(const UiContext& ui, AppModel& model, TunePanel& state) {
  TuneModel& tune = model.tune();
  const auto trial = tune.in_use();
  if (!trial) return;
  if (tune.tried()) {
    const char* slot = slot_name(model.presets().slots().active_slot());
    ImGui::AlignTextToFramePadding();
    ImGui::Text("Trial %zu tried as %s", *trial + 1, slot);
    ui.items.note_last("tune/tried");
    same_line_if_room(ImGui::CalcTextSize("Keep").x + ui.px(16));
    if (text_button(ui, "tune/keep", "Keep", "A and B both take these values; undo brings back what there was"))
      tune.keep();
    same_line_if_room(ImGui::CalcTextSize("Put back").x + ui.px(16));
    if (text_button(ui, "tune/put_back", "Put back",
                    "To the values there were before; the trial stays in the other slot"))
      tune.put_back();
  }
  const char* save = "Save preset";
  const float button = ImGui::CalcTextSize(save).x + 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputTextWithHint("##tune_name", "name", &state.name);
  ui.items.note_last("tune/name");
  if (auto given = ui.items.take_value("tune/name")) state.name = *given;
  tooltip(ui, "Name of the preset's file, without .toml");
  ImGui::SameLine();
  if (text_button(ui, "tune/save", save,
                  "Saves the values in use, with the motion that they were tuned on as evidence"))
    save_in_use(model, state);
}

}  // namespace

void draw_tune_text(const UiContext& ui, const std::string& text, ImU32 ink) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

bool save_tuned(AppModel& model, const std::string& name) {
  TuneModel& tune = model.tune();
  std::string note = "tuned for";
  for (const sweep::Objective& objective : tune.asked().objectives) note += " " + std::string(objective.name());
  for (const sweep::Constraint& constraint : tune.asked().constraints) note += ", " + constraint.text();
  note += ", on " + tune.motion_text();
  if (!model.presets().save(name, origin_of(model, note))) return false;
  if (tune.can_attach())
    model.evidence().attach(tune.evidence_motion(model.presets().folder()), tune.poses());
  else
    model.messages().say(Severity::note, "without evidence: the mesh that it was tuned on is not the one in view");
  return true;
}

void draw_tune_panel(const UiContext& ui, AppModel& model, TunePanel& state) {
  if (!section(ui, "Tune", state.open)) return;
  TuneModel& tune = model.tune();
  ImGui::PushFont(ui.fonts.small);
  const bool question = question_shown(ui, tune);
  draw_tune_start(ui, tune);
  if (question) {
    draw_tune_question(ui, model);
  } else {
    draw_tune_text(ui, question_text(tune.question()), ui.colours.text_dim);
  }
  if (!tune.trials().empty()) {
    draw_asked(ui, tune);
    draw_in_use(ui, model, state);
    draw_tune_plots(ui, model, state);
    draw_brushed(ui, model);
    draw_tune_table(ui, model);
  }
  ImGui::PopFont();
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
