// Two recordings side by side, or one under the present values: curves of both on one axis, their difference below.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

struct ShownUnit {
  double scale;
  const char* name;
};

ShownUnit unit_shown(std::size_t channel) {
  const std::string_view name = kComparedChannels[channel];
  if (name.ends_with("_n")) return {1.0, "N"};
  if (name == "error_m") return {1e6, "\u00b5m"};
  if (name.ends_with("_m")) return {1e3, "mm"};
  return {1.0, ""};
}

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

/// Rows of bars over the width, a column a bin.
struct BarPlot {
  ImDrawList& draw;
  ImVec2 at;
  float width, height;
  double low, high;
  float x(std::size_t i, std::size_t count) const {
    return at.x + width * static_cast<float>(i) / static_cast<float>(count);
  }
  float y(double value) const {
    const double share = high > low ? (value - low) / (high - low) : 0.5;
    return at.y + height * static_cast<float>(1.0 - share);
  }
  void bar(std::size_t i, std::size_t count, double least, double most, ImU32 ink) const {
    const float top = y(most), bottom = std::max(y(least), top + 1.0f);
    draw.AddRectFilled({x(i, count), top}, {std::max(x(i + 1, count), x(i, count) + 1.0f), bottom}, ink);
  }
};

void draw_labels(const UiContext& ui, const BarPlot& plot, const ShownUnit& unit) {
  ImFont* font = ui.fonts.small_number;
  const auto label = [&](double value, float y) {
    plot.draw.AddText(font, font->FontSize, {plot.at.x + ui.px(2), y}, ui.colours.text_faint,
                      (printed("%.4g ", value * unit.scale) + unit.name).c_str());
  };
  label(plot.high, plot.at.y);
  label(plot.low, plot.at.y + plot.height - font->FontSize);
}

/// The bin under the pointer; null: none.
const ComparedBin* draw_curves(const UiContext& ui, const RecordingsCompared& c, std::size_t channel) {
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(110), below = ui.px(56);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::InvisibleButton("##recordings/plot", {width, height + below + ui.px(3)});
  ui.items.note_last("recordings/plot");
  double low = std::numeric_limits<double>::infinity(), high = -low, most = 0.0;
  for (const ComparedBin& bin : c.bins) {
    if (bin.ticks == 0) continue;
    low = std::min({low, bin.least_a[channel], bin.least_b[channel]});
    high = std::max({high, bin.most_a[channel], bin.most_b[channel]});
    most = std::max(most, bin.at_most[channel]);
  }
  if (!(low <= high)) return nullptr;
  const BarPlot curves{draw, at, width, height, low, high};
  const BarPlot differences{draw, {at.x, at.y + height + ui.px(3)}, width, below, 0.0, most};
  for (const BarPlot* plot : {&curves, &differences})
    draw.AddRectFilled(plot->at, {plot->at.x + width, plot->at.y + plot->height}, ui.colours.plot, ui.px(2));
  const ImU32 ink_a = ui.colours.accent, ink_b = ui.colours.warning;
  const auto pale = [](ImU32 ink) { return (ink & 0x00FFFFFFu) | 0x90000000u; };
  for (std::size_t i = 0; i < c.bins.size(); ++i) {
    const ComparedBin& bin = c.bins[i];
    if (bin.ticks == 0) continue;
    curves.bar(i, c.bins.size(), bin.least_a[channel], bin.most_a[channel], pale(ink_a));
    curves.bar(i, c.bins.size(), bin.least_b[channel], bin.most_b[channel], pale(ink_b));
    differences.bar(i, c.bins.size(), 0.0, bin.at_most[channel], ui.colours.text_faint);
    if (bin.at_least[channel] > 0.0) differences.bar(i, c.bins.size(), 0.0, bin.at_least[channel], ui.colours.text_dim);
  }
  draw_labels(ui, curves, unit_shown(channel));
  draw_labels(ui, differences, unit_shown(channel));
  if (!ImGui::IsItemHovered()) return nullptr;
  const auto i =
      static_cast<std::size_t>((ImGui::GetIO().MousePos.x - at.x) / width * static_cast<float>(c.bins.size()));
  return i < c.bins.size() && c.bins[i].ticks > 0 ? &c.bins[i] : nullptr;
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

void draw_outcome(const UiContext& ui, const RecordingPairModel& model, const RecordingsCompared& c) {
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
    const bool length = q.unit == "m";
    const double scale = length ? 1e6 : 1.0;
    const char* unit = length ? "\u00b5m" : q.unit == "1" ? "" : "N";
    std::string value = printed("%.4g", scale * q.at_most);
    if (!c.full) value = printed("%.3g", scale * q.at_least) + " to " + value;
    fact(ui, std::string(q.name).c_str(), value, unit, q.over > 0 ? std::optional(ui.colours.warning) : std::nullopt);
    tooltip(ui,
            printed("Largest difference, at tick %llu of the first%s", static_cast<unsigned long long>(q.worst_tick),
                    c.full ? printed("; RMS %.4g", scale * q.rms).c_str() : ""));
  }
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
  draw_outcome(ui, model, *found);
  if (!found->alignment.aligned()) return;
  draw_recordings_legend(ui, model);
  if (const ComparedBin* bin = draw_curves(ui, *found, model.channel)) {
    const ShownUnit unit = unit_shown(model.channel);
    const auto range = [&](double least, double most) {
      return printed("%.5g to %.5g ", unit.scale * least, unit.scale * most) + unit.name;
    };
    tooltip(ui, printed("From tick %llu of the first, %llu ticks\nfirst ", static_cast<unsigned long long>(bin->first),
                        static_cast<unsigned long long>(bin->ticks)) +
                    range(bin->least_a[model.channel], bin->most_a[model.channel]) + "\nsecond " +
                    range(bin->least_b[model.channel], bin->most_b[model.channel]) + "\ndifference at most " +
                    printed("%.5g ", unit.scale * bin->at_most[model.channel]) + unit.name);
  }
  if (text_button(ui, "recordings/largest", "Largest difference", "The half second around it, tick by tick"))
    model.go_to_largest();
  if (model.zoomed()) {
    ImGui::SameLine(0, ui.px(3));
    if (text_button(ui, "recordings/whole", "All ticks", "Compares all ticks again")) model.show_whole();
  }
  ImGui::Dummy({1, ui.px(3)});
  draw_compared_spectra(ui, *found, model.channel);
}

}  // namespace tangent
