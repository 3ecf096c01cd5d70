// What Tune searches for: numbers to make small, what to keep to, values and where they are tried, on which motion.
#include "workbench/gui/panels/tune_parts.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <charconv>

namespace tangent {

namespace {

constexpr std::array<std::string_view, 3> kMotionLabels{"Ticks in view, or A to B", "The open recording",
                                                        "Exploration path"};
constexpr std::array<std::string_view, 2> kSearchLabels{"Evolve (NSGA-II)", "Even draws"};

/// A dim word at the left of a row; returns what is left of the width.
float row_label(const UiContext& ui, const char* label) {
  const float width = ImGui::GetContentRegionAvail().x, room = ui.px(52);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(room);
  return width - room + ui.px(8);
}

void draw_objectives(const UiContext& ui, TuneModel& tune) {
  const auto columns = sweep::number_columns();
  const auto& chosen = tune.question().objectives;
  for (std::size_t i = 0; i < std::min(chosen.size() + 1, TuneQuestion::kMostObjectives); ++i) {
    const float room = row_label(ui, i == 0 ? "Small" : "and");
    std::vector<std::string> names;
    if (i > 0) names.emplace_back(i < chosen.size() ? "nothing else" : "one more");
    for (const sweep::NumberColumn& column : columns) names.push_back(column_with_unit(column));
    const std::vector<std::string_view> views(names.begin(), names.end());
    const int before = i > 0 ? 1 : 0;
    int at = i < chosen.size() ? static_cast<int>(chosen[i].column - columns.data()) + before : 0;
    const bool other = choice_row(ui, printed("tune/objective/%zu", i), room, views, at);
    tooltip(ui,
            "A number of the run that is made small. Of several, presets are searched for none of which is better "
            "in everything: the front");
    if (other) tune.set_objective(i, at < before ? nullptr : &columns[static_cast<std::size_t>(at - before)]);
  }
}

void draw_constraints(const UiContext& ui, AppModel& model) {
  TuneModel& tune = model.tune();
  const std::vector<sweep::Constraint> constraints = tune.question().constraints;
  for (std::size_t i = 0; i < std::min(constraints.size() + 1, TuneQuestion::kMostConstraints); ++i) {
    const float room = row_label(ui, i == 0 ? "Keep" : "and");
    const std::string text = i < constraints.size() ? constraints[i].text() : std::string();
    const auto typed = number_box(ui, printed("tune/constraint/%zu", i), room, text);
    tooltip(ui,
            "What a preset has to keep to: NAME <= VALUE, or NAME = 0, with a name of the numbers above, as in "
            "p99_iterations <= 6. Empty: nothing");
    if (!typed) continue;
    if (const Status set = tune.set_constraint(i, *typed); !set)
      model.messages().say(Severity::error, set.error().message());
  }
}

void choose_tuned_key(const UiContext& ui, TuneModel& tune, std::size_t i, float width) {
  const auto& ranges = tune.question().ranges;
  std::vector<std::string_view> names{i < ranges.size() ? "leave it out" : "one more"};
  std::vector<const PresetKey*> of{nullptr};
  const auto add = [&](const PresetKey* key) { names.push_back(key->label), of.push_back(key); };
  for (const PresetKey* key : tune.keys()) {
    const auto same = [key](const sweep::Range& range) { return range.key == key; };
    if ((i < ranges.size() && ranges[i].key == key) || std::none_of(ranges.begin(), ranges.end(), same)) add(key);
  }
  const PresetKey* now = i < ranges.size() ? ranges[i].key : nullptr;
  if (std::find(of.begin(), of.end(), now) == of.end()) add(now);  // the method reads other keys than before
  int chosen = static_cast<int>(std::find(of.begin(), of.end(), now) - of.begin());
  const bool other = choice_row(ui, printed("tune/key/%zu", i), width, names, chosen);
  tooltip(ui, "A value that is tuned");
  if (other) tune.set_key(i, of[static_cast<std::size_t>(chosen)]);
}

void draw_ranges(const UiContext& ui, AppModel& model) {
  TuneModel& tune = model.tune();
  const float box = ui.px(58), gap = ui.px(4);
  const std::size_t count = tune.question().ranges.size();
  for (std::size_t i = 0; i < std::min(count + 1, TuneQuestion::kMostRanges); ++i) {
    const float width = ImGui::GetContentRegionAvail().x, beside = width - 2.0f * (box + gap);
    const bool below = beside < ui.px(150);  // both ends, where there is little room
    choose_tuned_key(ui, tune, i, below ? width : beside);
    if (i >= tune.question().ranges.size() || i >= count) continue;
    const sweep::Range range = tune.question().ranges[i];
    const auto end = [&](const char* name, double value) -> std::optional<double> {
      if (!below || std::string_view(name) == "to") ImGui::SameLine(0, gap);
      const auto typed = number_box(ui, printed("tune/%s/%zu", name, i), box, display_text(*range.key, value));
      tooltip(ui, printed("%s value that is tried, %s", std::string(name) == "from" ? "Least" : "Largest",
                          std::string(display_unit(*range.key).name).c_str()));
      const auto parsed = typed ? parse_typed(*range.key, *typed) : Result<double>(value);
      if (!parsed) model.messages().say(Severity::error, parsed.error().message());
      return typed && parsed ? std::optional(*parsed) : std::nullopt;
    };
    if (const auto from = end("from", range.from)) tune.set_range(i, *from, range.to);
    if (const auto to = end("to", range.to)) tune.set_range(i, range.from, *to);
  }
}

void draw_how(const UiContext& ui, TuneModel& tune) {
  int motion = static_cast<int>(tune.question().motion);
  const float room = row_label(ui, "On");
  if (choice_row(ui, "tune/motion", room, kMotionLabels, motion)) tune.set_motion(static_cast<TuneMotion>(motion));
  tooltip(ui,
          "The motion that every trial solves, at most 10,000 ticks of it; three quarters are searched on, the last "
          "is held back for the verdict");
  const float rest = row_label(ui, "By"), count = ui.px(58);
  if (tune.can_evolve()) {
    int search = tune.question().evolve ? 0 : 1;
    if (choice_row(ui, "tune/search", rest - count - ui.px(4), kSearchLabels, search)) tune.set_evolve(search == 0);
    tooltip(ui, "NSGA-II goes on from what is best so far; even draws fill the ranges, whatever comes out");
  } else {
    int search = 0;
    choice_row(ui, "tune/search", rest - count - ui.px(4), std::span(kSearchLabels).subspan(1), search);
    tooltip(ui, "This program was built without pagmo, so trials are even draws over the ranges");
  }
  ImGui::SameLine(0, ui.px(4));
  if (const auto typed = number_box(ui, "tune/trials", count, std::to_string(tune.question().trials))) {
    std::size_t n = tune.question().trials;
    std::from_chars(typed->data(), typed->data() + typed->size(), n);
    tune.set_trials(n);
  }
  tooltip(ui, "Trials in all, 10 to 5000");
  if (!tune.can_evolve())
    draw_tune_text(ui, "Built without pagmo: trials are even draws. The heat map and sweeps work as ever",
                   ui.colours.text_dim);
}

}  // namespace

void draw_tune_question(const UiContext& ui, AppModel& model) {
  draw_objectives(ui, model.tune());
  draw_constraints(ui, model);
  draw_ranges(ui, model);
  draw_how(ui, model.tune());
}

}  // namespace tangent
