// Toolbar above the plots: plot type, follow / hold / inspect, cursors A and B, legend of the ghost, export to CSV and
// PNG.
#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/save_panel.h"
#include "workbench/gui/widgets/widgets.h"

#include <cmath>

namespace tangent {

namespace {

void draw_modes(const UiContext& ui, PlotsPanel& state) {
  struct Mode {
    PlotsMode mode;
    const char* name;
    const char* doc;
  };
  constexpr Mode kModes[] = {
      {PlotsMode::time, "Time", "Every curve against time"},
      {PlotsMode::xy, "X-Y", "One curve against another, for the ticks in view"},
      {PlotsMode::spectrum, "Spectrum", "Spectrum of a curve: is the loop buzzing?"},
      {PlotsMode::histogram, "Histogram", "Histogram of a curve's values, for the ticks in view"}};
  for (const Mode& m : kModes) {
    bool on = state.mode == m.mode;
    if (toggle_button(ui, std::string("plots/mode/") + m.name, m.name, on, m.doc)) state.mode = m.mode;
    ImGui::SameLine(0, ui.px(3));
  }
  toggle_button(ui, "plots/channels", "Channels", state.channels.open,
                "Every channel, to drag onto a plot, and new ones: difference, derivative, filter, magnitude");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "plots/values", "Values", state.values,
                "Minimum, maximum, mean and RMS of what is in view, values at A and B");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "plots/legend", "Legend", state.legend, "What the bands, flags and marks in the plots mean");
  ImGui::SameLine(0, ui.px(14));
}

/// Follow: the newest tick stays at the right edge. Hold: the axis is fixed, ticks go on. Inspect: paused.
void draw_following(const UiContext& ui, TimeModel& time) {
  bool follow = !time.paused() && time.axis().following(), inspect = time.paused(), hold = !follow && !inspect;
  if (toggle_button(ui, "plots/follow", "Follow", follow, "The newest tick stays at the right edge (End)"))
    time.go_live();
  ImGui::SameLine(0, ui.px(3));
  if (toggle_button(ui, "plots/hold", "Hold", hold,
                    "Freezes the axes while the rest of the window goes on; panning does the same")) {
    time.set_paused(false);
    time.axis().hold();
  }
  ImGui::SameLine(0, ui.px(3));
  if (toggle_button(ui, "plots/inspect", "Inspect", inspect, "Holds the whole window on one tick (Space)"))
    time.set_paused(true);
  ImGui::SameLine(0, ui.px(14));
}

void draw_cursors(const UiContext& ui, TimeModel& time, PlotLink& link) {
  const auto place = [&](const char* path, const char* letter, std::optional<std::uint64_t>& cursor, const char* doc) {
    bool on = cursor.has_value();
    if (toggle_button(ui, path, letter, on, doc)) {
      const ServoRecord* record = time.tick().record();
      if (!on || record == nullptr)
        cursor.reset();
      else
        cursor = record->tick.tick;
    }
    ImGui::SameLine(0, ui.px(3));
  };
  place("plots/cursor_a", "A", link.a, "Sets cursor A on the tick in view, or removes it; also Ctrl-click in a plot");
  place("plots/cursor_b", "B", link.b, "Sets cursor B on the tick in view, or removes it; also Shift-click in a plot");
  if (!link.a || !link.b) return;
  const double dt = (static_cast<double>(*link.b) - static_cast<double>(*link.a)) * link.tick_period_s;
  ImGui::PushFont(ui.fonts.small_number);
  const std::string text =
      printed("B\u2212A %.3f s", dt) + (dt != 0.0 ? printed(" %.4g Hz", 1.0 / std::abs(dt)) : std::string());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopFont();
  ImGui::SameLine(0, ui.px(14));
}

/// What the pale curves are, and how they compare: one preset against one, never the recording's mixture.
std::string ghost_text(const TimeModel& time) {
  const std::shared_ptr<const ChannelStore> ghost = time.ghost_channels();
  if (ghost == nullptr) return {};
  if (!time.paused()) {
    const auto [from, to] = ticks_in_view(time);
    const auto mean = [from = from, to = to](const ChannelStore& store, std::size_t channel) {
      return store.sums(channel, from, to).mean();
    };
    return printed("Beside, same motion assumed: the other slot, %.2f iterations per tick in view; rendered %.2f",
                   mean(*ghost, static_cast<std::size_t>(GhostChannel::iterations)),
                   mean(time.store(), static_cast<std::size_t>(Channel::iterations)));
  }
  const auto both = time.time_machine().compared();
  if (!both) return "Ghost, same motion assumed";
  return printed("Ghost, same motion assumed: iterations %.2f \u2192 %.2f, contact changed in %llu ticks",
                 both->before_numbers.mean_iterations, both->after_numbers.mean_iterations,
                 static_cast<unsigned long long>(both->changed_ticks));
}

void draw_ghost_note(const UiContext& ui, const TimeModel& time, float right) {
  const std::string text = ghost_text(time);
  if (text.empty()) return;
  const char* shorter = "Ghost: same motion assumed";
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(11));
  const float room = right - ImGui::GetCursorScreenPos().x - ui.px(10);
  const char* shown = ImGui::CalcTextSize(text.c_str()).x < room ? text.c_str() : shorter;
  if (ImGui::CalcTextSize(shown).x > room) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.warning);
  ImGui::TextUnformatted(shown);
  ImGui::PopStyleColor();
  ui.items.note_last("plots/ghost");
  tooltip(ui, text);
  ImGui::SameLine();
}

/// Instead of the buttons below while a file is written.
void draw_writing(const UiContext& ui, ExportModel& exports) {
  if (text_button(ui, "plots/cancel_writing", "Cancel", "Stops writing the file; nothing of it is left"))
    exports.cancel();
  ImGui::SameLine(0, ui.px(6));
  ImGui::AlignTextToFramePadding();
  ImGui::Text("%s, %.0f s", exports.what().c_str(), exports.seconds());
}

void draw_exports(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& whole) {
  if (text_button(ui, "plots/csv", "CSV",
                  "Every recorded tick in view, all channels, as a CSV file; between A and B if both are set")) {
    const auto [from, to] = ticks_in_view(model.time());
    const auto& [a, b] = std::pair(state.link.a, state.link.b);
    const HistorySnapshot& records = model.time().past().shown().records;
    if (a && b)
      model.exports().write_ticks(records, std::min(*a, *b), std::max(*a, *b) + 1, file_origin(model));
    else
      model.exports().write_ticks(records, from, to, file_origin(model));
  }
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "plots/png", "PNG", "The plots as they are, as a PNG file"))
    model.exports().ask_for_picture("plots", whole);
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "plots/figure", "SVG", "The plots in view as a figure for a paper: SVG or PDF"))
    ask_to_save(model, SaveWhat::plots);
}

}  // namespace

void draw_plots_toolbar(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect, const Rect& whole) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(6), ui.px(2)));
  ImGui::SetCursorScreenPos({rect.x + ui.px(8), rect.y + 0.5f * (rect.h - ImGui::GetFrameHeight())});
  draw_modes(ui, state);
  draw_following(ui, model.time());
  draw_cursors(ui, model.time(), state.link);
  const float out_width = ImGui::CalcTextSize("CSVPNGSVG").x + ui.px(36 + 6 + 10);
  const float out_x = rect.right() - out_width;
  draw_ghost_note(ui, model.time(), out_x);
  if (ImGui::GetCursorScreenPos().x < out_x) {
    ImGui::SetCursorScreenPos({out_x, rect.y + 0.5f * (rect.h - ImGui::GetFrameHeight())});
    if (model.exports().writing()) {
      draw_writing(ui, model.exports());
    } else {
      draw_exports(ui, model, state, whole);
    }
  }
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

}  // namespace tangent
