#include "workbench/gui/panels/sweep_points.h"

#include "workbench/gui/panels/panels.h"
#include "workbench/gui/plots/mark_drawing.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

using Axis = TuningModel::Axis;

/// Positions in the plot: shares of the axes, so that logarithmic keys are spread.
double share_of(const Axis& axis, double value) {
  const bool factors = axis.key->logarithmic && axis.from > 0.0 && axis.to > 0.0 && value > 0.0;
  const double span = factors ? std::log(axis.to / axis.from) : axis.to - axis.from;
  if (span == 0.0) return 0.5;
  return (factors ? std::log(value / axis.from) : value - axis.from) / span;
}

/// The plot's area and scales.
struct SweepArea {
  ImVec2 min, max;
  double top = 2.0;  ///< planes at the upper edge; one at the lower, on a logarithmic scale
  float x(double share) const { return min.x + static_cast<float>(std::clamp(share, -0.02, 1.02)) * (max.x - min.x); }
  float y(double planes) const {
    const double share = std::log(std::clamp(planes, 1.0, top)) / std::log(top);
    return max.y - static_cast<float>(share) * (max.y - min.y);
  }
};

void draw_planes_axis(const UiContext& ui, const SweepArea& area) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small_number;
  for (const int planes : {1, 2, 3, 5, 10, 20, 30, 50, 100, 200, 300, 500, 1000}) {
    if (planes > area.top) break;
    const float y = std::round(area.y(planes));
    draw.AddLine({area.min.x, y}, {area.max.x, y}, ui.colours.grid_minor);
    const std::string label = std::to_string(planes);
    const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, label.c_str()).x;
    draw.AddText(font, font->FontSize, {area.min.x - w - ui.px(5), y - 0.5f * font->FontSize}, ui.colours.text_dim,
                 label.c_str());
  }
}

/// Labels of the first key's ends under the plot, and its name between them.
void draw_ends(const UiContext& ui, const SweepArea& area, const Axis& axis) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small;
  const auto width = [font](const std::string& s) {
    return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, s.c_str()).x;
  };
  const std::string low = display_text(*axis.key, axis.from), high = display_with_unit(*axis.key, axis.to),
                    name(axis.key->label);
  const float y = area.max.y + ui.px(2);
  draw.AddText(font, font->FontSize, {area.min.x, y}, ui.colours.text_dim, low.c_str());
  draw.AddText(font, font->FontSize, {area.max.x - width(high), y}, ui.colours.text_dim, high.c_str());
  draw.AddText(font, font->FontSize, {0.5f * (area.min.x + area.max.x - width(name)), y}, ui.colours.text_dim,
               name.c_str());
}

/// Mean as a line with dots, p99 as rings, and where ticks failed a bar from below, its height the share that did.
void draw_curve(const UiContext& ui, const TuningModel& tuning, const SweepArea& area, std::vector<ImVec2>& places) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const Axis& axis = tuning.axes()[0];
  for (const TuningModel::Point& point : tuning.points()) {
    const sweep::CellNumbers& n = point.numbers;
    const float x = area.x(share_of(axis, point.values[0]));
    places.push_back({x, area.y(n.mean_iterations)});
    if (const std::uint64_t failed = TuningModel::failures(point); failed > 0) {
      const double share = static_cast<double>(failed) / static_cast<double>(std::max<std::uint64_t>(1, n.ticks));
      const float high = std::max(ui.px(3), static_cast<float>(share) * (area.max.y - area.min.y));
      draw.AddRectFilled({x - ui.px(2.5f), area.max.y - high}, {x + ui.px(2.5f), area.max.y},
                         packed(with_alpha(ui.palette.bad, 0.75f)));
    }
    draw.AddCircle({x, area.y(n.p99_iterations)}, ui.px(3), ui.colours.text_dim, 14, ui.px(1.2f));
  }
  for (std::size_t i = 1; i < places.size(); ++i)
    draw.AddLine(places[i - 1], places[i], packed(ui.palette.iterations), ui.px(1.4f));
  for (std::size_t i = 0; i < places.size(); ++i)
    draw.AddCircleFilled(places[i], ui.px(3.4f),
                         tuning.points()[i].by_hand ? beside_ink(ui) : packed(ui.palette.iterations), 16);
}

void mark_present(const UiContext& ui, const AppModel& model, const TuningModel& tuning, const SweepArea& area) {
  const Axis& a = tuning.axes()[0];
  const double at = share_of(a, a.key->get(model.presets().current()));
  if (at < 0.0 || at > 1.0) return;
  ImGui::GetWindowDrawList()->AddLine({area.x(at), area.min.y}, {area.x(at), area.max.y}, ui.colours.accent, ui.px(1));
}

void draw_legend(const UiContext& ui, const SweepArea& area) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y = area.min.y - ui.px(8);
  float x = area.min.x + ui.px(4);
  const auto text = [&](const char* words) {
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {x + ui.px(7), y - 0.5f * ui.fonts.small->FontSize},
                 ui.colours.text_dim, words);
    x += ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9f, 0.0f, words).x + ui.px(20);
  };
  draw.AddCircleFilled({x, y}, ui.px(3.4f), packed(ui.palette.iterations), 16);
  text("mean iterations");
  draw.AddCircle({x, y}, ui.px(3), ui.colours.text_dim, 14, ui.px(1.2f));
  text("p99");
  draw.AddRectFilled({x - ui.px(2.5f), y - ui.px(4)}, {x + ui.px(2.5f), y + ui.px(4)},
                     packed(with_alpha(ui.palette.bad, 0.75f)));
  text("failed");
  draw.AddCircleFilled({x, y}, ui.px(3.4f), beside_ink(ui), 16);
  text("by hand");
}

/// The value that theory names.
void mark_theory(const UiContext& ui, const TuningModel& tuning, const SweepArea& area) {
  const auto theory = tuning.theory(0);
  const double at = theory ? share_of(tuning.axes()[0], *theory) : -1.0;
  if (at < 0.0 || at > 1.0) return;
  const float x = area.x(at);
  draw_dashes(*ImGui::GetWindowDrawList(), {x, area.min.y}, {x, area.max.y}, ui.px(4), ui.colours.text_dim,
              ui.px(1.2f));
}

}  // namespace

std::string sweep_point_text(const TuningModel& tuning, const TuningModel::Point& point) {
  std::string text;
  std::size_t v = 0;
  for (const Axis& axis : tuning.axes()) {
    if (axis.key == nullptr) continue;
    text += std::string(axis.key->label) + " " + display_with_unit(*axis.key, point.values[v++]) + "\n";
  }
  const sweep::CellNumbers& n = point.numbers;
  return text + printed("mean %.3f iterations, p99 %.0f, most %.0f\n%llu of %llu ticks failed", n.mean_iterations,
                        n.p99_iterations, n.most_iterations,
                        static_cast<unsigned long long>(TuningModel::failures(point)),
                        static_cast<unsigned long long>(n.ticks));
}

std::size_t nearest_sweep_point(const UiContext& ui, const std::vector<ImVec2>& places, bool by_column) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  std::size_t found = places.size();
  float least = ui.px(by_column ? 14 : 24);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float d =
        by_column ? std::abs(mouse.x - places[i].x) : std::hypot(mouse.x - places[i].x, mouse.y - places[i].y);
    if (d >= least) continue;
    least = d;
    found = i;
  }
  return found;
}

void note_sweep_points(const UiContext& ui, const std::vector<ImVec2>& places) {
  for (std::size_t i = 0; i < places.size(); ++i)
    ui.items.note(printed("sweep/point/%zu", i), {places[i].x - 1.0f, places[i].y - 1.0f},
                  {places[i].x + 1.0f, places[i].y + 1.0f});
}

void draw_sweep_points(const UiContext& ui, AppModel& model) {
  TuningModel& tuning = model.tuning();
  if (tuning.axes()[1].key != nullptr) return draw_sweep_field(ui, model);
  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x), height = ui.px(160);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##sweep_points", {width, height});
  ui.items.note_last("sweep/plot");
  const bool here = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  SweepArea area{{at.x + ui.px(34), at.y + ui.px(18)}, {at.x + width - ui.px(6), at.y + height - ui.px(17)}};
  if (area.max.x - area.min.x < ui.px(40)) return;
  ImGui::GetWindowDrawList()->AddRectFilled(area.min, area.max, ui.colours.plot);
  for (const TuningModel::Point& p : tuning.points()) area.top = std::max(area.top, 1.15 * p.numbers.p99_iterations);
  std::vector<ImVec2> places;
  draw_planes_axis(ui, area);
  mark_theory(ui, tuning, area);
  mark_present(ui, model, tuning, area);
  draw_curve(ui, tuning, area, places);
  draw_legend(ui, area);
  draw_ends(ui, area, tuning.axes()[0]);
  note_sweep_points(ui, places);
  const std::size_t pointed = here ? nearest_sweep_point(ui, places, true) : places.size();
  if (pointed == places.size()) return;
  ImGui::GetWindowDrawList()->AddCircle(places[pointed], ui.px(6.5f), ui.colours.text, 20, ui.px(1.2f));
  ImGui::SetTooltip("%s\nClick: try it", sweep_point_text(tuning, tuning.points()[pointed]).c_str());
  if (clicked) tuning.try_point(pointed);
}

}  // namespace tangent
