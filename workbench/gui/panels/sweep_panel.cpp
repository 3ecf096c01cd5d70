// A sweep over one or two keys on the chosen ticks: what is swept, and the points so far (sweep_points.h).
#include "core/io/csv_table.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/sweep_points.h"
#include "workbench/gui/widgets/nearest_names.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <charconv>

namespace tangent {

namespace {

using Axis = TuningModel::Axis;

constexpr std::array<std::string_view, 3> kShownNames{"Iterations, mean", "Iterations, 99th percentile",
                                                      "Failures, share of the ticks"};

/// Of `names` the one that was typed: a label, or a key's own name, "solver.gain_curvature_m" or "gain_curvature_m".
Result<std::size_t> key_given(std::span<const std::string_view> names, std::span<const PresetKey* const> of,
                              const std::string& given) {
  std::vector<std::string> full(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (of[i] != nullptr) full[i] = of[i]->full_name();
    if (names[i] == given || (of[i] != nullptr && (of[i]->key == given || full[i] == given))) return i;
  }
  const std::vector<std::string_view> all(full.begin(), full.end());
  return fail(show_text(given) + " is no value that can be swept under this method", {}, nearest_text(given, all));
}

void choose_key(const UiContext& ui, TuningModel& tuning, std::size_t axis, float width) {
  const auto keys = tuning.keys_to_sweep();
  std::vector<std::string_view> names;
  std::vector<const PresetKey*> of;
  if (axis == 1) {
    names.push_back("no second key");
    of.push_back(nullptr);
  }
  for (const PresetKey* key : keys) {
    if (key == tuning.axes()[1 - axis].key && axis == 1) continue;
    names.push_back(key->label);
    of.push_back(key);
  }
  const auto at = static_cast<std::size_t>(std::find(of.begin(), of.end(), tuning.axes()[axis].key) - of.begin());
  if (at == of.size()) {
    // The method reads other keys than before.
    names.push_back(tuning.axes()[axis].key->label);
    of.push_back(tuning.axes()[axis].key);
  }
  const std::string path = printed("sweep/key/%zu", axis);
  int chosen = static_cast<int>(at);
  if (const auto given = ui.items.take_value(path)) {
    const auto named = key_given(names, of, *given);
    if (!named) ui.items.refuse(named.error().message());
    if (named) chosen = static_cast<int>(*named), tuning.set_key(axis, of[*named]);
  }
  if (choice_row(ui, path, width, names, chosen)) tuning.set_key(axis, of[static_cast<std::size_t>(chosen)]);
}

void draw_axis(const UiContext& ui, AppModel& model, std::size_t i) {
  TuningModel& tuning = model.tuning();
  const float width = ImGui::GetContentRegionAvail().x, box = ui.px(54), count = ui.px(32);
  choose_key(ui, tuning, i, width - 2.0f * box - count - ui.px(14));
  const Axis& axis = tuning.axes()[i];
  if (axis.key == nullptr) return;
  const auto end = [&](const char* name, double value) -> std::optional<double> {
    ImGui::SameLine(0, ui.px(4));
    const auto typed = number_box(ui, printed("sweep/%s/%zu", name, i), box, display_text(*axis.key, value));
    tooltip(ui, printed("%s value, %s", std::string(name) == "from" ? "First" : "Last",
                        std::string(display_unit(*axis.key).name).c_str()));
    if (!typed) return std::nullopt;
    const auto parsed = parse_typed(*axis.key, *typed);
    if (!parsed) model.messages().say(Severity::error, parsed.error().message());
    return parsed ? std::optional(*parsed) : std::nullopt;
  };
  if (const auto from = end("from", axis.from)) tuning.set_range(i, *from, axis.to);
  if (const auto to = end("to", axis.to)) tuning.set_range(i, axis.from, *to);
  ImGui::SameLine(0, ui.px(4));
  if (const auto typed = number_box(ui, printed("sweep/count/%zu", i), count, printed("%zu", axis.count))) {
    std::size_t n = 0;
    const char* const end_of_text = typed->data() + typed->size();
    if (std::from_chars(typed->data(), end_of_text, n).ptr == end_of_text && n >= 2 && n <= 100)
      tuning.set_count(i, n);
    else
      model.messages().say(Severity::error, show_text(*typed) + " is no number of values: write 2 to 100");
  }
  tooltip(ui, "Number of values, 2 to 100");
}

void draw_start(const UiContext& ui, AppModel& model) {
  TuningModel& tuning = model.tuning();
  if (tuning.sweep().running() || tuning.waits()) {
    if (text_button(ui, "sweep/cancel", "Cancel", "Stops and keeps the points so far")) tuning.cancel_sweep();
    ImGui::SameLine();
    if (tuning.waits())
      ImGui::TextDisabled("reading A to B: %.0f %%", 100.0 * model.time().selection_progress());
    else
      ImGui::TextDisabled("%zu of %zu", tuning.sweep().done(), tuning.sweep().planned());
    return;
  }
  const char* label = model.time().selection_solvable() ? "Sweep A to B" : "Sweep the recorded ticks";
  if (text_button(ui, "sweep/start", label,
                  "Solves these ticks again with every value, on the same motion, in the background. Cursors A and B "
                  "choose the ticks"))
    tuning.start_sweep();
  const char* map = "Heat map";
  same_line_if_room(ImGui::CalcTextSize(map).x + ui.px(16));
  if (text_button(
          ui, "sweep/heat_map", map,
          "Two values on the same ticks as a field of colours, coarse first: G_k and G_d where no second one is "
          "chosen"))
    tuning.start_heat_map();
  if (tuning.points().empty()) return;
  same_line_if_room(ImGui::CalcTextSize("Clear").x + ui.px(16));
  if (text_button(ui, "sweep/clear", "Clear", "Deletes the points")) tuning.clear_points();
}

}  // namespace

void draw_sweep_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Sweep", state.open)) return;
  TuningModel& tuning = model.tuning();
  ImGui::PushFont(ui.fonts.small);
  draw_axis(ui, model, 0);
  draw_axis(ui, model, 1);
  draw_start(ui, model);
  if (!tuning.points().empty()) {
    const TickRange& range = tuning.points_range();
    ImGui::TextDisabled("Ticks %llu to %llu%s", static_cast<unsigned long long>(range.from),
                        static_cast<unsigned long long>(range.to),
                        tuning.outdated() ? "; other values have changed since" : "");
    ui.items.note_last("sweep/range");
  }
  if (!tuning.points().empty() && tuning.axes()[1].key != nullptr) {
    int shows = static_cast<int>(tuning.shows);
    if (choice_row(ui, "sweep/shows", ImGui::GetContentRegionAvail().x, kShownNames, shows))
      tuning.shows = static_cast<TuningModel::Shows>(shows);
    tooltip(ui, "What the colours are: planes a tick, or the share of the ticks that fail. Of the map's colours");
  }
  if (!tuning.points().empty()) draw_sweep_points(ui, model);
  ImGui::PopFont();
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
