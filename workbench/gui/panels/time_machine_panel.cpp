// Result of solving the recorded ticks under the current preset.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <cmath>

namespace tangent {

namespace {

std::string count_text(std::uint64_t n) { return printed("%llu", static_cast<unsigned long long>(n)); }

struct ComparedRow {
  const char* label;
  std::string before, after;
  int better = 0;  ///< the second is better (1) or worse (-1)
};

int sign_of(double before, double after) {
  if (after == before) return 0;
  return after < before ? 1 : -1;
}

std::vector<ComparedRow> compared_rows(const PresetsCompared& both) {
  const RunNumbers &was = both.before_numbers, &is = both.after_numbers;
  const auto um = [](double m) { return printed("%.3g", m * 1e6); };
  std::vector<ComparedRow> rows{
      {"Iterations, mean", printed("%.3f", was.mean_iterations), printed("%.3f", is.mean_iterations),
       sign_of(was.mean_iterations, is.mean_iterations)},
      {"p99", printed("%d", was.p99_iterations), printed("%d", is.p99_iterations),
       sign_of(was.p99_iterations, is.p99_iterations)},
      {"most", printed("%d", was.most_iterations), printed("%d", is.most_iterations),
       sign_of(was.most_iterations, is.most_iterations)},
      {"Error, mean \u00b5m", um(was.mean_error_m), um(is.mean_error_m), sign_of(was.mean_error_m, is.mean_error_m)},
      {"worst \u00b5m", um(was.worst_error_m), um(is.worst_error_m), sign_of(was.worst_error_m, is.worst_error_m)},
      {"Unconverged", count_text(was.unconverged), count_text(is.unconverged),
       sign_of(static_cast<double>(was.unconverged), static_cast<double>(is.unconverged))}};
  if (both.before_ns > 0.0 && both.after_ns > 0.0)
    rows.push_back({"Time per tick, ns", printed("%.0f", both.before_ns), printed("%.0f", both.after_ns),
                    sign_of(both.before_ns, both.after_ns)});
  return rows;
}

std::string range_text(const PresetsCompared& both, const TimeModel& time) {
  const double period = time.tick_period_s();
  return printed("%s ticks, %.3f to %.3f s%s", count_text(both.before_numbers.ticks).c_str(),
                 static_cast<double>(both.from_tick) * period, static_cast<double>(both.end_tick - 1) * period,
                 time.selection() && time.selection()->from == both.from_tick ? " (A to B)" : "");
}

void draw_comparison(const UiContext& ui, const TimeModel& time, const PresetsCompared& both) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float second = width, first = width - ui.px(82);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto line = [&](const char* label, const std::string& a, const std::string& b, ImU32 ink, ImFont* values) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const auto right = [&](const std::string& text, float x, ImU32 colour) {
      const float w = values->CalcTextSizeA(values->FontSize, 1e9f, 0.0f, text.c_str()).x;
      draw.AddText(values, values->FontSize, {at.x + x - w, at.y}, colour, text.c_str());
    };
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, at, ui.colours.text_dim, label);
    right(a, first, values == ui.fonts.small ? ink : ui.colours.text);
    right(b, second, ink);
    ImGui::Dummy({width, ui.fonts.small->FontSize + ui.px(2)});
  };
  ImGui::PushFont(ui.fonts.small);
  ImGui::TextUnformatted(range_text(both, time).c_str());
  ImGui::PopFont();
  ui.items.note_last("time_machine/range");
  tooltip(ui,
          "Both presets are solved on these ticks, in turns of 64, in the background: counts and processor time can be "
          "compared. The recording itself, which may span other presets, is in neither column. Cursors A and B choose "
          "the ticks");
  line("", time.name_before(), time.name_after(), ui.colours.text_dim, ui.fonts.small);
  for (const ComparedRow& row : compared_rows(both)) {
    const ImU32 ink = row.before == row.after ? ui.colours.text
                      : row.better > 0        ? ui.colours.good
                      : row.better < 0        ? ui.colours.warning
                                              : ui.colours.text;
    line(row.label, row.before, row.after, ink, ui.fonts.small_number);
  }
}

void draw_changes(const UiContext& ui, TimeModel& time, const PresetsCompared& numbers) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::Text("Contact changed in %s of %s ticks", count_text(numbers.changed_ticks).c_str(),
              count_text(numbers.after_numbers.ticks).c_str());
  tooltip(ui,
          "Touching, free or unconverged where it was not, or moved by more than ten tolerances. A click goes to where "
          "it moved most");
  ImGui::PopFont();
  if (numbers.changes.empty()) return;
  ImGui::PushFont(ui.fonts.small_number);
  ImGui::TextDisabled(" %9s %5s  %9s  %s", "tick", "ticks", "moved by", "status");
  const float row = ImGui::GetTextLineHeight() + ui.px(3);
  const float height = row * static_cast<float>(std::min<std::size_t>(5, numbers.changes.size())) + ui.px(6);
  ImGui::BeginChild("changes", {0.0f, height}, true);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(numbers.changes.size()));
  const ServoRecord* seen = time.tick().record();
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const ContactChange& c = numbers.changes[static_cast<std::size_t>(i)];
      const std::string moved =
          c.moved_m < 1e-3 ? printed("%6.1f \u00b5m", c.moved_m * 1e6) : printed("%6.2f mm", c.moved_m * 1e3);
      const std::string what = c.recorded == c.resolved
                                   ? std::string()
                                   : printed("  %s \u2192 %s", to_string(c.recorded), to_string(c.resolved));
      const std::string text = printed("%9llu %5llu", static_cast<unsigned long long>(c.first_tick),
                                       static_cast<unsigned long long>(c.ticks)) +
                               "  " + moved + what;
      const bool here = seen != nullptr && seen->tick.tick >= c.first_tick && seen->tick.tick <= c.last_tick;
      if (ImGui::Selectable((text + printed("##change%d", i)).c_str(), here)) time.select_tick(c.worst_tick);
      ui.items.note_last(printed("time_machine/change/%d", i));
      tooltip(ui, printed("Ticks %llu to %llu", static_cast<unsigned long long>(c.first_tick),
                          static_cast<unsigned long long>(c.last_tick)));
    }
  }
  ImGui::EndChild();
  ImGui::PopFont();
}

void draw_state(const UiContext& ui, const TimeModel& time) {
  const TimeMachine& machine = time.time_machine();
  const auto verified = machine.verified();
  const std::size_t ticks = machine.run()->records.size();
  fact(ui,
       time.past().kept_selection() != nullptr && time.recording() != nullptr ? "Read from A to B"
       : time.recording() != nullptr                                          ? "Loaded of the recording"
       : time.past().shows_kept()                                             ? "Kept around bookmarks"
                                                                              : "Frozen past",
       printed("%.1f", static_cast<double>(ticks) * time.tick_period_s()), "s");
  tooltip(ui, "Can still be solved again, until the view goes back to live");
  fact(ui, "Memory beyond the history", printed("%.1f", static_cast<double>(time.frozen_bytes()) / (1024.0 * 1024.0)),
       "MiB");
  ui.items.note_last("time_machine/memory");
  if (!verified)
    fact(ui, "Replay", "checking ...");
  else if (verified->numbers.different_ticks == 0)
    fact(ui, "Replay", "the same bits in every tick", "", ui.colours.good);
  else
    fact(ui, "Replay", count_text(verified->numbers.different_ticks) + " ticks differ", "", ui.colours.bad);
  tooltip(ui, "Every tick solved again with the values it was recorded with");
}

/// The selected ticks are kept, but in no view: a way to them.
void draw_way_to_selection(const UiContext& ui, TimeModel& time) {
  if (!time.selection_kept() || time.past().shown().covers(time.selection()->from)) return;
  if (text_button(ui, "time_machine/selection", "Show A to B",
                  time.recording() != nullptr
                      ? "The view is elsewhere in the recording"
                      : "The history has dropped these ticks; they are kept while the cursors are set"))
    time.select_tick(time.selection()->from);
}

/// Ticks of a recording that are to be solved, and are not in memory.
void draw_reading(const UiContext& ui, TimeModel& time) {
  if (time.selection_loading()) {
    fact(ui, "Reading A to B", printed("%.0f", 100.0 * time.selection_progress()), "%");
    ui.items.note_last("time_machine/reading");
    if (text_button(ui, "time_machine/cancel_reading", "Cancel", "What is loaded stays as it is"))
      time.cancel_loading();
  } else if (time.selection_to_load()) {
    if (text_button(ui, "time_machine/read", "Read A to B",
                    "These ticks are not in memory: read whole, they can be solved again, as far as memory allows"))
      time.load_selection();
  }
}

}  // namespace

void draw_time_machine_panel(const UiContext& ui, TimeModel& time, FoldedPanel& state) {
  const bool open = section(ui, "Time machine", state.open);
  if (!open) return;
  draw_way_to_selection(ui, time);
  if (!time.time_machine().is_open()) {
    ImGui::PushFont(ui.fonts.small);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.text_dim);
    ImGui::TextWrapped(
        "Pause (Space), then change a value: the whole past is solved again with it, and drawn beside what was "
        "recorded.");
    ImGui::PopStyleColor();
    ImGui::PopFont();
    return;
  }
  draw_state(ui, time);
  draw_reading(ui, time);
  const auto ghost = time.ghost();
  if (!ghost) {
    if (text_button(ui, "time_machine/solve", "Solve the past with the current values",
                    "Changing any value does this automatically"))
      time.solve_past_again();
    ImGui::Dummy({1, ui.px(3)});
    return;
  }
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.warning);
  ImGui::TextUnformatted(ghost->whole ? "Same motion assumed" : "Same motion assumed; still solving the rest ...");
  ImGui::PopStyleColor();
  ImGui::PopFont();
  ui.items.note_last("time_machine/same_motion");
  tooltip(ui,
          "The hand moved as it did under the recorded values; with others it would have moved differently. This "
          "compares the "
          "solver on the same poses");
  if (const auto both = time.time_machine().compared()) {
    draw_comparison(ui, time, *both);
    draw_changes(ui, time, *both);
  } else {
    ImGui::TextDisabled("Solving both presets, in turns ...");
  }
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
