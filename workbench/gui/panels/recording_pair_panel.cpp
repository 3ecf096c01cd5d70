// Two recordings side by side, or one under the present values: curves of both on one axis, their difference below.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/recording_pair_curves.h"
#include "workbench/gui/widgets/widgets.h"

namespace tangent {

namespace {

constexpr std::array<std::string_view, kComparedChannelCount> kChannelLabels{
    "Force x",   "Force y",   "Force z",     "Display", "Contact x",
    "Contact y", "Contact z", "Penetration", "Error",   "Iterations"};

void path_row(const UiContext& ui, const char* path, const char* label, std::filesystem::path& to, const char* doc) {
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(ui.px(64));
  if (const auto typed = number_box(ui, path, width - ui.px(58), to.string())) to = *typed;
  tooltip(ui, doc);
}

void draw_question(const UiContext& ui, RecordingPairModel& model) {
  path_row(ui, "recordings/first", "First", model.first, "A recording's file");
  path_row(ui, "recordings/second", "Second", model.second,
           "Another recording's file. Empty: the first one's motion under the present values, same motion assumed");
  const float width = ImGui::GetContentRegionAvail().x;
  int by = static_cast<int>(model.by);
  if (choice_row(ui, "recordings/align", 0.36f * width, kAlignByNames, by)) model.by = static_cast<AlignBy>(by);
  tooltip(ui, "Which ticks go together: of the same time or number, or counted from the first contact or bookmark");
  ImGui::SameLine(0, ui.px(3));
  int channel = static_cast<int>(model.channel);
  if (choice_row(ui, "recordings/curve", 0.36f * width, kChannelLabels, channel))
    model.channel = static_cast<std::size_t>(channel);
  tooltip(ui, "The curve that is drawn");
  ImGui::SameLine(0, ui.px(3));
  if (model.running()) {
    if (text_button(ui, "recordings/stop", "Stop", "What is found so far stays")) model.stop();
  } else if (text_button(ui, "recordings/compare", "Compare",
                         "First by minima and maxima, then tick by tick, in the background")) {
    model.compare();
  }
}

void draw_recordings_legend(const UiContext& ui, const RecordingPairModel& model) {
  const auto name = [&](const std::filesystem::path& path) {
    return path.empty() ? std::string("present values") : path.filename().string();
  };
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.accent);
  ImGui::TextUnformatted(name(model.first).c_str());
  ImGui::PopStyleColor();
  ImGui::SameLine(0, ui.px(10));
  ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.warning);
  ImGui::TextUnformatted(name(model.second).c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void draw_outcome(const UiContext& ui, AppModel& app, const RecordingsCompared& c) {
  RecordingPairModel& model = app.recording_pair();
  const bool same = c.outcome == CompareOutcome::same;
  std::string text = same                                     ? "The same, within the tolerances"
                     : c.outcome == CompareOutcome::different ? "Different"
                     : c.outcome == CompareOutcome::undecided ? "Minima and maxima leave it open"
                                                              : "Not aligned: " + c.why;
  if (model.running()) text += c.full ? "" : "; comparing tick by tick ...";
  ImGui::PushStyleColor(ImGuiCol_Text, same ? ui.colours.good : ui.colours.warning);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ui.items.note_last("recordings/outcome");
  if (!c.alignment.aligned()) return;
  fact(ui, "Ticks compared", printed("%llu", static_cast<unsigned long long>(c.compared)));
  for (const QuantityDifference& q : c.quantities) {
    const std::string name(q.name);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool here = model.chosen() && *model.chosen() == q.worst_tick && q.at_most > 0.0;
    if (ImGui::Selectable(("##difference/" + name).c_str(), here, 0, {0.0f, ui.fonts.text->FontSize})) {
      model.choose(q.worst_tick);
      app.show_compared(false);
    }
    ui.items.note_last("recordings/difference/" + name);
    ImGui::SetCursorScreenPos(at);
    const bool length = q.unit == "m";
    const double scale = length ? 1e6 : 1.0;
    const char* unit = length ? "\u00b5m" : q.unit == "1" ? "" : "N";
    std::string value = printed("%.4g", scale * q.at_most);
    if (!c.full) value = printed("%.3g", scale * q.at_least) + " to " + value;
    fact(ui, name.c_str(), value, unit, q.over > 0 ? std::optional(ui.colours.warning) : std::nullopt);
    tooltip(ui, printed("Largest difference, at tick %llu of the first%s\nA click shows that tick",
                        static_cast<unsigned long long>(q.worst_tick),
                        c.full ? printed("; RMS %.4g", scale * q.rms).c_str() : ""));
  }
}

std::string text_of_bin(const ComparedBin& bin, std::size_t channel) {
  const ComparedUnit unit = unit_of_compared(channel);
  const auto range = [&](double least, double most) {
    return printed("%.5g to %.5g ", unit.scale * least, unit.scale * most) + unit.name;
  };
  return printed("From tick %llu of the first, %llu ticks\nfirst ", static_cast<unsigned long long>(bin.first),
                 static_cast<unsigned long long>(bin.ticks)) +
         range(bin.least_a[channel], bin.most_a[channel]) + "\nsecond " +
         range(bin.least_b[channel], bin.most_b[channel]) + "\ndifference at most " +
         printed("%.5g ", unit.scale * bin.at_most[channel]) + unit.name + "\nA click shows that tick of the first";
}

/// From the comparison to the window's time, and to the largest difference.
void draw_ways(const UiContext& ui, AppModel& app) {
  RecordingPairModel& model = app.recording_pair();
  const std::string what = model.chosen()
                               ? printed("Tick %llu of the first", static_cast<unsigned long long>(*model.chosen()))
                               : std::string("The largest difference");
  if (text_button(ui, "recordings/in_first", "In the first",
                  (what + ", in the window's time; the first is opened where it is not").c_str()))
    app.show_compared(false);
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "recordings/in_second", "In the second",
                  (what + ": the tick that goes with it, in the window's time").c_str()))
    app.show_compared(true);
  if (text_button(ui, "recordings/largest", "Largest difference", "The half second around it, tick by tick"))
    model.go_to_largest();
  if (!model.zoomed()) return;
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "recordings/whole", "All ticks", "Compares all ticks again")) model.show_whole();
}

}  // namespace

void draw_recording_pair_panel(const UiContext& ui, AppModel& app, FoldedPanel& state) {
  if (!section(ui, "Compare recordings", state.open)) return;
  RecordingPairModel& model = app.recording_pair();
  ImGui::PushFont(ui.fonts.small);
  draw_question(ui, model);
  ImGui::PopFont();
  const auto found = model.result();
  if (found == nullptr) {
    ImGui::TextDisabled(model.running() ? "Comparing ..." : "");
    ImGui::Dummy({1, ui.px(3)});
    return;
  }
  draw_outcome(ui, app, *found);
  if (!found->alignment.aligned()) return;
  draw_recordings_legend(ui, model);
  const ComparedPointer pointer = draw_compared_curves(ui, *found, model.channel, model.chosen());
  if (pointer.over != nullptr) tooltip(ui, text_of_bin(*pointer.over, model.channel));
  if (pointer.clicked) {
    model.choose(*pointer.clicked);
    app.show_compared(false);
  }
  draw_ways(ui, app);
  ImGui::Dummy({1, ui.px(3)});
  draw_compared_spectra(ui, *found, model.channel);
}

}  // namespace tangent
