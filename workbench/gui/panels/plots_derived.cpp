// A curve computed from others, over time: what to compute, of which curves, and the plot.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>

namespace tangent {

namespace {

constexpr std::array<std::string_view, 4> kHow{"Difference a - b", "Derivative of a", "Low-pass filter of a",
                                               "Magnitude of a, b, c"};
constexpr std::array<double, 7> kCutoffs_hz{5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 400.0};
constexpr std::array<std::string_view, 7> kCutoffNames{"5 Hz", "10 Hz", "20 Hz", "50 Hz", "100 Hz", "200 Hz", "400 Hz"};

void draw_choices(const UiContext& ui, DerivedPlot& state, std::span<const std::string_view> names) {
  const auto labelled = [&](const char* path, const char* label, std::span<const std::string_view> choices, int& chosen,
                            float width) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(0, ui.px(5));
    choice_row(ui, path, ui.px(width), choices, chosen);
    ImGui::SameLine(0, ui.px(10));
  };
  labelled("plots/derived/how", "Show", kHow, state.how, 170);
  const auto how = static_cast<Derivation>(state.how);
  labelled("plots/derived/a", "a", names, state.a, 150);
  if (how == Derivation::difference || how == Derivation::magnitude)
    labelled("plots/derived/b", "b", names, state.b, 150);
  if (how == Derivation::magnitude) labelled("plots/derived/c", "c", names, state.c, 150);
  if (how == Derivation::low_pass) labelled("plots/derived/cutoff", "up to", kCutoffNames, state.cutoff, 90);
}

/// A view for this choice. Curves of other units are taken as they are, in the unit of a.
PlotSpec spec_of(Derivation how, const CurveRef& a, const std::string& title) {
  PlotSpec spec;
  spec.id = "derived";
  spec.title = title;
  spec.unit = a.plot->unit + (how == Derivation::derivative ? (a.plot->unit.empty() ? "1/s" : "/s") : "");
  spec.scale = a.plot->scale;
  spec.format = "%8.4g";
  if (how == Derivation::low_pass)
    spec.series.push_back({"recorded", DerivedCurve::kOfA, &Palette::tick_time, a.series->steps});
  spec.series.push_back({"derived", DerivedCurve::kDerived, a.series->colour, false});
  return spec;
}

}  // namespace

void draw_derived_plot(const UiContext& ui, AppModel& model, PlotsPanel& panel, const Rect& rect) {
  DerivedPlot& state = panel.derived;
  const std::vector<CurveRef> curves = curves_of(panel);
  std::vector<std::string> names;
  for (const CurveRef& curve : curves) names.push_back(curve.name());
  const std::vector<std::string_view> views(names.begin(), names.end());
  const int last = static_cast<int>(curves.size()) - 1;
  for (int* chosen : {&state.a, &state.b, &state.c}) *chosen = std::clamp(*chosen, 0, last);
  ImGui::SetCursorScreenPos({rect.x, rect.y});
  ImGui::BeginChild("derived_plot", {rect.w, rect.h}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(6), ui.px(2)));
  ImGui::SetCursorScreenPos({rect.x + ui.px(8), rect.y + ui.px(2)});
  draw_choices(ui, state, views);
  const float used = ImGui::GetFrameHeight() + ui.px(4);
  ImGui::PopStyleVar();
  ImGui::PopFont();

  const auto curve = [&](int i) -> const CurveRef& { return curves[static_cast<std::size_t>(i)]; };
  const auto how = static_cast<Derivation>(std::clamp(state.how, 0, 3));
  const auto cutoff = static_cast<std::size_t>(std::clamp(state.cutoff, 0, static_cast<int>(kCutoffs_hz.size()) - 1));
  std::string title = names[static_cast<std::size_t>(state.a)];
  if (how == Derivation::difference) title += " \u2212 " + names[static_cast<std::size_t>(state.b)];
  if (how == Derivation::derivative) title = "Derivative of " + title;
  if (how == Derivation::low_pass) title += ", up to " + std::string(kCutoffNames[cutoff]);
  if (how == Derivation::magnitude)
    title = "Magnitude of " + title + ", " + names[static_cast<std::size_t>(state.b)] + ", " +
            names[static_cast<std::size_t>(state.c)];
  if (!state.view || state.title != title) {
    state.view.emplace(spec_of(how, curve(state.a), title));
    state.title = title;
  }
  const DerivedSpec spec{
      how,
      {curve(state.a).series->channel, curve(state.b).series->channel, curve(state.c).series->channel},
      kCutoffs_hz[cutoff],
      model.time().tick_period_s()};
  const ChannelStore& store = state.curve.update(model.time().store(), spec);
  PlotLink link = panel.link;
  link.ghost = nullptr;  // another store's ticks
  link.marks.event_channel.reset();
  state.view->draw(ui, store, model.time().axis(), link, {rect.x, rect.y + used}, {rect.w, rect.h - used}, true);
  ImGui::EndChild();
  panel.link.hover_next = link.hover_next;
  panel.link.clicked = link.clicked;
  panel.link.a = link.a;
  panel.link.b = link.b;
}

}  // namespace tangent
