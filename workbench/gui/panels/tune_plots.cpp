// The trials as points: in two objectives, with the front as a line, and in two keys. A rectangle drawn in either
// brushes them, a click tries the nearest.
#include "workbench/gui/panels/trial_axis.h"
#include "workbench/gui/panels/tune_parts.h"
#include "workbench/gui/plots/axes_drawing.h"
#include "workbench/gui/plots/mark_drawing.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {

namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// One of the two plots in this frame.
struct TrialPlot {
  const UiContext& ui;
  TuneModel& tune;
  TrialAxis x, y;
  PlainPlot plot;

  /// A trial beyond an axis lies on its edge.
  ImVec2 at(std::size_t trial) const {
    const sweep::Trial& t = tune.trials()[trial];
    const auto share = [](const TrialAxis& axis, double value) {
      return std::clamp(static_cast<float>(axis.plain.share(axis.plain.log ? std::max(value, 1e-30) : value)), 0.0f,
                        1.0f);
    };
    return {plot.area.min.x + share(x, x.shown(t)) * plot.area.width(),
            plot.area.max.y - share(y, y.shown(t)) * plot.area.height()};
  }
  ImU32 front_ink() const { return packed(ui.palette.iterations); }
};

void draw_theory(const TrialPlot& p) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const PlotArea& area = p.plot.area;
  for (const bool across : {true, false}) {
    const TrialAxis& axis = across ? p.x : p.y;
    const auto theory = axis.of.key ? p.tune.theory(axis.of.index) : std::nullopt;
    if (!theory) continue;
    const auto share = static_cast<float>(axis.plain.share(*theory / axis.in_si));
    if (!(share >= 0.0f && share <= 1.0f)) continue;
    const float x = area.min.x + share * area.width(), y = area.max.y - share * area.height();
    draw_dashes(draw, across ? ImVec2(x, area.min.y) : ImVec2(area.min.x, y),
                across ? ImVec2(x, area.max.y) : ImVec2(area.max.x, y), p.ui.px(4), p.ui.colours.text_dim,
                p.ui.px(1.2f));
  }
}

/// The border of what the front beats: of two objectives only, and of trials that keep the constraints.
void draw_front_line(const TrialPlot& p) {
  if (p.x.of.key || p.tune.asked().objectives.size() != 2 || p.x.of == p.y.of) return;
  std::vector<ImVec2> places;
  for (const std::size_t i : p.tune.front())
    if (p.tune.trials()[i].missed <= 0.0) places.push_back(p.at(i));
  std::sort(places.begin(), places.end(), [](ImVec2 a, ImVec2 b) { return a.x < b.x; });
  std::vector<ImVec2> stairs;
  for (const ImVec2 place : places) {
    if (!stairs.empty()) stairs.push_back({place.x, stairs.back().y});
    stairs.push_back(place);
  }
  ImGui::GetWindowDrawList()->AddPolyline(stairs.data(), static_cast<int>(stairs.size()), p.front_ink(), 0,
                                          p.ui.px(1.4f));
}

void draw_trial(const TrialPlot& p, std::size_t i, bool front) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const UiContext& ui = p.ui;
  const ImVec2 at = p.at(i);
  const bool brushed = p.tune.brushed(i), broken = p.tune.trials()[i].missed > 0.0;
  if (broken)
    draw_cross(draw, at, ui.px(2.5f), brushed ? ui.colours.bad : packed(with_alpha(ui.palette.bad, 0.55f)),
               ui.px(brushed ? 1.8f : 1.1f));
  else if (front)
    draw.AddCircleFilled(at, ui.px(3.4f), p.front_ink(), 16);
  else
    draw.AddCircleFilled(at, ui.px(2.0f), packed(with_alpha(ui.palette.text_dim, brushed ? 0.9f : 0.45f)), 12);
  if (brushed && !broken) draw.AddCircle(at, ui.px(front ? 4.6f : 3.4f), ui.colours.accent, 16, ui.px(1.5f));
}

void draw_all_trials(const TrialPlot& p) {
  std::vector<bool> front(p.tune.trials().size(), false);
  for (const std::size_t i : p.tune.front()) front[i] = true;
  for (const bool now : {false, true})
    for (std::size_t i = 0; i < front.size(); ++i)
      if (front[i] == now) draw_trial(p, i, now);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_diamond(draw, p.at(0), p.ui.px(5.5f), p.ui.colours.text, p.ui.px(1.5f));
  if (const auto trial = p.tune.in_use())
    draw.AddCircle(p.at(*trial), p.ui.px(6), p.ui.colours.text, 20, p.ui.px(1.6f));
}

/// The value at a place, in SI; at the plot's edges no end, so that trials beyond them are in.
double si_at(const TrialAxis& axis, float share) {
  if (share <= 0.005f) return -kNoEnd;
  if (share >= 0.995f) return kNoEnd;
  return axis.plain.value_at(static_cast<double>(share)) * axis.in_si;
}

void draw_band(const TrialPlot& p, ImVec2 a, ImVec2 b) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 min{std::min(a.x, b.x), std::min(a.y, b.y)}, max{std::max(a.x, b.x), std::max(a.y, b.y)};
  draw.AddRectFilled(min, max, p.ui.colours.accent_soft);
  draw.AddRect(min, max, p.ui.colours.accent, 0.0f, 0, p.ui.px(1));
}

/// The brush, where it belongs to this plot.
void draw_brush(const TrialPlot& p) {
  const auto& brush = p.tune.brush();
  if (!brush || !(brush->axes[0] == p.x.of) || !(brush->axes[1] == p.y.of)) return;
  const auto share = [](const TrialAxis& axis, double si) {
    if (std::isinf(si)) return si < 0.0 ? 0.0f : 1.0f;
    return std::clamp(static_cast<float>(axis.plain.share(si / axis.in_si)), 0.0f, 1.0f);
  };
  const PlotArea& area = p.plot.area;
  draw_band(
      p,
      {area.min.x + share(p.x, brush->from[0]) * area.width(), area.max.y - share(p.y, brush->from[1]) * area.height()},
      {area.min.x + share(p.x, brush->to[0]) * area.width(), area.max.y - share(p.y, brush->to[1]) * area.height()});
}

void take_brush(TrialPlot& p, ImVec2 a, ImVec2 b) {
  const PlotArea& area = p.plot.area;
  TuneBrush brush;
  brush.axes = {p.x.of, p.y.of};
  const auto across = [&](float x) { return (x - area.min.x) / area.width(); };
  const auto up = [&](float y) { return (area.max.y - y) / area.height(); };
  brush.from = {si_at(p.x, across(std::min(a.x, b.x))), si_at(p.y, up(std::max(a.y, b.y)))};
  brush.to = {si_at(p.x, across(std::max(a.x, b.x))), si_at(p.y, up(std::min(a.y, b.y)))};
  p.tune.set_brush(brush);
}

std::optional<std::size_t> nearest_trial(const TrialPlot& p) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  std::optional<std::size_t> found;
  float least = p.ui.px(9);
  for (std::size_t i = 0; i < p.tune.trials().size(); ++i) {
    const ImVec2 at = p.at(i);
    const float d = std::hypot(mouse.x - at.x, mouse.y - at.y);
    if (d < least) least = d, found = i;
  }
  return found;
}

/// After the plot's button: drag brushes, click tries, a click beside all points lets go.
void handle_mouse(TrialPlot& p, bool hovered, bool active, bool released) {
  const ImGuiIO& io = ImGui::GetIO();
  const PlotArea& area = p.plot.area;
  const auto inside = [&](ImVec2 at) {
    return ImVec2(std::clamp(at.x, area.min.x, area.max.x), std::clamp(at.y, area.min.y, area.max.y));
  };
  const ImVec2 from = inside(io.MouseClickedPos[0]), to = inside(io.MousePos);
  const bool dragged = std::hypot(to.x - from.x, to.y - from.y) > p.ui.px(4);
  if (active && dragged) draw_band(p, from, to);
  if (released && dragged) return take_brush(p, from, to);
  const auto pointed = hovered && !(active && dragged) ? nearest_trial(p) : std::nullopt;
  if (pointed) {
    ImGui::GetWindowDrawList()->AddCircle(p.at(*pointed), p.ui.px(7), p.ui.colours.accent, 20, p.ui.px(1.4f));
    ImGui::SetTooltip("%s\nClick: try it. Drag: brush", trial_text(p.tune, *pointed).c_str());
  }
  if (!released || !hovered) return;
  if (pointed)
    p.tune.try_trial(*pointed);
  else
    p.tune.set_brush(std::nullopt);
}

void draw_trial_plot(const UiContext& ui, TuneModel& tune, const char* path, const TrialAxis& x, const TrialAxis& y) {
  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x), height = ui.px(180);
  const ImVec2 pos = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(path, {width, height});
  ui.items.note_last(path);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive(),
             released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  TrialPlot p{ui, tune, x, y, {plain_area(ui, pos, {width, height}), x.plain, y.plain}};
  if (p.plot.area.width() < ui.px(40)) return;
  p.plot.x.label = fitted(ui.fonts.small, p.plot.x.label, p.plot.area.width());
  draw_axes(ui, p.plot);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float rim = ui.px(4);  // marks on the edges stay whole
  draw.PushClipRect({p.plot.area.min.x - rim, p.plot.area.min.y - rim},
                    {p.plot.area.max.x + rim, p.plot.area.max.y + rim}, true);
  draw_theory(p);
  draw_front_line(p);
  draw_brush(p);
  draw_all_trials(p);
  for (const std::size_t i : tune.front()) {
    const ImVec2 at = p.at(i);
    ui.items.note(printed("%s/%zu", path, i), {at.x - 1.0f, at.y - 1.0f}, {at.x + 1.0f, at.y + 1.0f});
  }
  handle_mouse(p, hovered, active, released);
  draw.PopClipRect();
}

void draw_tune_legend(const UiContext& ui, const TuneModel& tune) {
  MarkLegend legend(ui);
  const ImU32 dim = ui.colours.text_dim;
  legend.item("front", [&](ImDrawList& draw, ImVec2 at) {
    draw.AddCircleFilled(at, ui.px(3.4f), packed(ui.palette.iterations), 16);
  });
  legend.item("beaten", [&](ImDrawList& draw, ImVec2 at) { draw.AddCircleFilled(at, ui.px(2), dim, 12); });
  legend.item("breaks a constraint",
              [&](ImDrawList& draw, ImVec2 at) { draw_cross(draw, at, ui.px(2.5f), ui.colours.bad, ui.px(1.3f)); });
  bool theory = false;
  for (std::size_t r = 0; r < tune.asked().ranges.size(); ++r) theory = theory || tune.theory(r);
  legend.item(theory ? "theory" : "as it was",
              [&](ImDrawList& draw, ImVec2 at) { draw_diamond(draw, at, ui.px(4.5f), ui.colours.text, ui.px(1.3f)); });
  legend.item("in use",
              [&](ImDrawList& draw, ImVec2 at) { draw.AddCircle(at, ui.px(4.5f), ui.colours.text, 18, ui.px(1.4f)); });
}

/// Which of several the axes show, where there is a choice.
void choose_axes(const UiContext& ui, const std::string& path, const std::vector<std::string>& names, int& across,
                 int& up) {
  const int last = static_cast<int>(names.size()) - 1;
  across = std::clamp(across, 0, last);
  up = std::clamp(up, 0, last);
  if (names.size() < 3) return;
  const std::vector<std::string_view> views(names.begin(), names.end());
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ui.px(4));
  choice_row(ui, path + "/across", half, views, across);
  tooltip(ui, "What the plot shows from left to right");
  ImGui::SameLine(0, ui.px(4));
  choice_row(ui, path + "/up", half, views, up);
  tooltip(ui, "What the plot shows upwards");
}

}  // namespace

void draw_tune_plots(const UiContext& ui, AppModel& model, TunePanel& state) {
  TuneModel& tune = model.tune();
  std::vector<std::string> objectives, keys;
  for (const sweep::Objective& objective : tune.asked().objectives)
    objectives.push_back(column_label(*objective.column));
  for (const sweep::Range& range : tune.asked().ranges) keys.emplace_back(range.key->label);
  choose_axes(ui, "tune/axis", objectives, state.across, state.up);
  const auto of = [](int i) { return static_cast<std::size_t>(i); };
  const TrialAxis first = objective_axis(tune, of(state.across));
  const bool one = objectives.size() == 1;
  draw_trial_plot(ui, tune, "tune/front", one ? key_axis(tune, 0) : first,
                  one ? first : objective_axis(tune, of(state.up)));
  draw_tune_legend(ui, tune);
  choose_axes(ui, "tune/keys", keys, state.key_across, state.key_up);
  draw_trial_plot(ui, tune, "tune/values", key_axis(tune, of(state.key_across)),
                  keys.size() == 1 ? first : key_axis(tune, of(state.key_up)));
}

}  // namespace tangent
