// A sweep of two keys as a heat map: coarse first, finer as cells come in; an outline around what fails.
#include "workbench/gui/model/coarse_first.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/sweep_points.h"
#include "workbench/gui/plots/axes_drawing.h"
#include "workbench/gui/plots/mark_drawing.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

using Shows = TuningModel::Shows;
using Point = TuningModel::Point;

/// The axis in shown units, half a cell beyond both ends of the grid.
PlainAxis field_axis(const PresetKey& key, const std::vector<double>& grid) {
  const DisplayUnit unit = display_unit(key);
  PlainAxis axis;
  axis.label = std::string(key.label) + (unit.name.empty() ? "" : ", " + std::string(unit.name));
  const auto [least, most] = std::minmax_element(grid.begin(), grid.end());
  axis.low = *least / unit.scale;
  axis.high = *most / unit.scale;
  const double steps = std::max(1.0, static_cast<double>(grid.size()) - 1.0);
  axis.log = key.logarithmic && axis.low > 0.0;
  if (axis.log) {
    const double half = std::pow(axis.high / axis.low, 0.5 / steps);
    axis.low /= half;
    axis.high *= half;
  } else {
    const double half = 0.5 * (axis.high - axis.low) / steps;
    axis.low -= half;
    axis.high += half;
  }
  if (!(axis.low < axis.high)) axis.low -= 0.5, axis.high += 0.5;
  return axis;
}

/// The grid of the last sweep with the points that are there, and what stands for those to come.
struct Field {
  const TuningModel& tuning;
  std::vector<double> columns, rows;
  std::vector<const Point*> cells;  ///< across + columns * up; null: nothing near it yet
  double low = 0.0, high = 0.0;     ///< values of the first and the last colour
  bool beyond = false;              ///< some are above the last

  double value(const Point& point) const {
    if (tuning.shows == Shows::mean) return point.numbers.mean_iterations;
    if (tuning.shows == Shows::p99) return point.numbers.p99_iterations;
    return static_cast<double>(TuningModel::failures(point)) /
           static_cast<double>(std::max<std::uint64_t>(1, point.numbers.ticks));
  }
  /// Iterations on a logarithmic scale.
  float shade(const Point& point) const {
    if (!(high > low)) return 0.0f;
    const double v = value(point);
    return static_cast<float>(tuning.shows == Shows::failures || low <= 0.0 ? (v - low) / (high - low)
                                                                            : std::log(v / low) / std::log(high / low));
  }
};

bool fails(const Point* point) { return point != nullptr && TuningModel::failures(*point) > 0; }

std::size_t index_in(const std::vector<double>& grid, double value) {
  const auto at = std::lower_bound(grid.begin(), grid.end(), value);
  return at != grid.end() && *at == value ? static_cast<std::size_t>(at - grid.begin()) : grid.size();
}

Field field_of(const TuningModel& tuning) {
  Field field{tuning, tuning.grid(0), tuning.grid(1), {}};
  std::sort(field.columns.begin(), field.columns.end());
  std::sort(field.rows.begin(), field.rows.end());
  field.low = tuning.shows == Shows::failures ? 0.0 : 1e300;
  const std::size_t across = field.columns.size(), up = field.rows.size();
  field.cells.assign(across * up, nullptr);
  std::vector<const Point*> there(across * up, nullptr);
  const auto& points = tuning.points();
  // Where something holds, the colours are for that: what fails has its cross, and would leave the others alike.
  const bool kept_only = tuning.shows != Shows::failures &&
                         std::count_if(points.begin(), points.end(), [](const Point& p) { return !fails(&p); }) > 1;
  for (const Point& point : points) {
    const bool counts = !kept_only || !fails(&point);
    if (counts) field.low = std::min(field.low, field.value(point));
    if (counts) field.high = std::max(field.high, field.value(point));
    const std::size_t i = index_in(field.columns, point.values[0]), j = index_in(field.rows, point.values[1]);
    if (i < across && j < up) there[i + across * j] = &point;
  }
  field.beyond = std::any_of(points.begin(), points.end(), [&](const Point& p) { return field.value(p) > field.high; });
  for (const std::size_t cell : coarse_first(across, up)) {
    if (there[cell] == nullptr) continue;
    const std::size_t i = cell % across, j = cell / across, step = coarse_step(i, j);
    for (std::size_t y = j; y < std::min(up, j + step); ++y)
      for (std::size_t x = i; x < std::min(across, i + step); ++x) field.cells[x + across * y] = there[cell];
  }
  return field;
}

struct FieldArea {
  const PlotArea& area;
  std::size_t across, up;
  float x(std::size_t i) const {
    return area.min.x + area.width() * static_cast<float>(i) / static_cast<float>(std::max<std::size_t>(1, across));
  }
  float y(std::size_t j) const {
    return area.max.y - area.height() * static_cast<float>(j) / static_cast<float>(std::max<std::size_t>(1, up));
  }
};

/// On any colour of the map: light on dark.
void on_colours(const UiContext& ui, const std::function<void(ImU32 ink, float thickness)>& stroke) {
  stroke(packed(ui.palette.panel), ui.px(3.4f));
  stroke(packed(ui.palette.text), ui.px(1.5f));
}

void draw_cells(const UiContext& ui, const Field& field, const FieldArea& at, ColourMap colours) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t j = 0; j < at.up; ++j)
    for (std::size_t i = 0; i < at.across; ++i) {
      const Point* point = field.cells[i + at.across * j];
      if (point == nullptr) continue;
      draw.AddRectFilled({at.x(i), at.y(j + 1)}, {at.x(i + 1), at.y(j)},
                         packed(colour_at(colours, field.shade(*point))));
    }
  on_colours(ui, [&](ImU32 ink, float thickness) {
    for (std::size_t j = 0; j < at.up; ++j)
      for (std::size_t i = 0; i < at.across; ++i) {
        const Point *here = field.cells[i + at.across * j],
                    *right = i + 1 < at.across ? field.cells[i + 1 + at.across * j] : here,
                    *above = j + 1 < at.up ? field.cells[i + at.across * (j + 1)] : here;
        if (here == nullptr) continue;
        if (right != nullptr && fails(here) != fails(right))
          draw.AddLine({at.x(i + 1), at.y(j)}, {at.x(i + 1), at.y(j + 1)}, ink, thickness);
        if (above != nullptr && fails(here) != fails(above))
          draw.AddLine({at.x(i), at.y(j + 1)}, {at.x(i + 1), at.y(j + 1)}, ink, thickness);
      }
  });
}

/// A cross in each cell that fails, as far as it has room.
void draw_failing(const UiContext& ui, const Field& field, const FieldArea& at) {
  const float room = std::min(at.x(1) - at.x(0), at.y(0) - at.y(1));
  if (room < ui.px(7)) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  on_colours(ui, [&](ImU32 ink, float thickness) {
    for (std::size_t j = 0; j < at.up; ++j)
      for (std::size_t i = 0; i < at.across; ++i)
        if (fails(field.cells[i + at.across * j]))
          draw_cross(draw, {0.5f * (at.x(i) + at.x(i + 1)), 0.5f * (at.y(j) + at.y(j + 1))},
                     std::min(0.25f * room, ui.px(4)), ink, thickness);
  });
}

ImVec2 place_of(const PlainPlot& plot, const TuningModel& tuning, double first, double second) {
  return plot.at(first / display_unit(*tuning.axes()[0].key).scale, second / display_unit(*tuning.axes()[1].key).scale);
}

/// What theory names for each key, and the values in use.
void draw_known(const UiContext& ui, const AppModel& model, const TuningModel& tuning, const PlainPlot& plot) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const PlotArea& area = plot.area;
  for (std::size_t a = 0; a < 2; ++a) {
    const auto theory = tuning.theory(a);
    if (!theory) continue;
    const ImVec2 at = place_of(plot, tuning, *theory, *theory);
    const ImVec2 from = a == 0 ? ImVec2(at.x, area.min.y) : ImVec2(area.min.x, at.y),
                 to = a == 0 ? ImVec2(at.x, area.max.y) : ImVec2(area.max.x, at.y);
    on_colours(ui, [&](ImU32 ink, float thickness) { draw_dashes(draw, from, to, ui.px(5), ink, 0.85f * thickness); });
  }
  const Preset& now = model.presets().current();
  const ImVec2 at = place_of(plot, tuning, tuning.axes()[0].key->get(now), tuning.axes()[1].key->get(now));
  on_colours(ui, [&](ImU32 ink, float thickness) { draw.AddCircle(at, ui.px(5), ink, 18, thickness); });
}

void draw_field_legend(const UiContext& ui, const Field& field, ColourMap colours) {
  MarkLegend legend(ui);
  const bool share = field.tuning.shows == Shows::failures;
  const auto text = [&](double v) { return share ? printed("%.3g %%", 100.0 * v) : printed("%.3g", v); };
  if (field.high >= field.low)
    legend.strip(text(field.low),
                 text(field.high) + (field.beyond ? " and more" : "") +
                     (share                               ? " of ticks fail"
                      : field.tuning.shows == Shows::mean ? " planes a tick"
                                                          : " planes, p99"),
                 colours);
  const ImU32 ink = ui.colours.text_dim;
  legend.item("fails", [&](ImDrawList& draw, ImVec2 at) { draw_cross(draw, at, ui.px(3.5f), ink, ui.px(1.4f)); });
  legend.item("theory", [&](ImDrawList& draw, ImVec2 at) {
    draw_dashes(draw, {at.x, at.y - ui.px(7)}, {at.x, at.y + ui.px(7)}, ui.px(3), ink, ui.px(1.4f));
  });
  legend.item("in use", [&](ImDrawList& draw, ImVec2 at) { draw.AddCircle(at, ui.px(4), ink, 16, ui.px(1.4f)); });
}

}  // namespace

void draw_sweep_field(const UiContext& ui, AppModel& model) {
  TuningModel& tuning = model.tuning();
  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x), height = ui.px(230);
  const ImVec2 pos = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##sweep_points", {width, height});
  ui.items.note_last("sweep/plot");
  const bool here = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  PlainPlot plot{plain_area(ui, pos, {width, height}), {}, {}};
  if (plot.area.width() < ui.px(40)) return;
  const Field field = field_of(tuning);
  plot.x = field_axis(*tuning.axes()[0].key, field.columns);
  plot.y = field_axis(*tuning.axes()[1].key, field.rows);
  plot.x.label = fitted(ui.fonts.small, plot.x.label, plot.area.width());
  draw_axes(ui, plot);
  const ColourMap colours = model.map().colours;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(plot.area.min, plot.area.max, true);
  const FieldArea at{plot.area, field.columns.size(), field.rows.size()};
  draw_cells(ui, field, at, colours);
  draw_failing(ui, field, at);
  std::vector<ImVec2> places;
  for (const Point& point : tuning.points()) {
    places.push_back(place_of(plot, tuning, point.values[0], point.values[1]));
    if (point.by_hand) draw.AddCircle(places.back(), ui.px(4), beside_ink(ui), 14, ui.px(1.5f));
  }
  draw_known(ui, model, tuning, plot);
  const std::size_t pointed = here ? nearest_sweep_point(ui, places, false) : places.size();
  if (pointed < places.size()) draw.AddCircle(places[pointed], ui.px(6.5f), ui.colours.text, 20, ui.px(1.2f));
  draw.PopClipRect();
  note_sweep_points(ui, places);
  draw_field_legend(ui, field, colours);
  if (pointed == places.size()) return;
  ImGui::SetTooltip("%s\nClick: try it", sweep_point_text(tuning, tuning.points()[pointed]).c_str());
  if (clicked) tuning.try_point(pointed);
}

}  // namespace tangent
