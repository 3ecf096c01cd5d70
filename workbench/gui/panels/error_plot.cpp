// Error against iteration for the tick in view, on a log axis, coloured by order as in the 3D view, with the curves of
// the previous ticks behind it.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/plots/curve_drawing.h"
#include "workbench/gui/plots/tick_locator.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kFloor_um = 1e-7;  ///< errors of 0 are drawn here: about the rounding of a 40 mm coordinate

double shown_um(double error_m) { return std::max(error_m * 1e6, kFloor_um); }
double shown_um(const IterationRecord& r) { return shown_um(r.error_m); }

/// Maps iteration and error to pixels.
struct ErrorScale {
  ImVec2 min, max;                ///< the area of the curve
  double low = 1.0, high = 10.0;  ///< um, whole decades
  double last = 4.0;              ///< iteration at the right end
  float inset = 0.0f;

  float x(double iteration) const {
    return min.x + inset + static_cast<float>(iteration / last) * (max.x - min.x - 2.0f * inset);
  }
  float y(double um) const {
    const double share = std::log10(std::max(um, low) / low) / std::log10(high / low);
    return max.y - static_cast<float>(share) * (max.y - min.y);
  }
  ImVec2 point(std::size_t i, const IterationRecord& r) const { return {x(static_cast<double>(i)), y(shown_um(r))}; }
};

/// A scale that contains all errors of the first `shown` iterations, and the tolerance.
ErrorScale make_scale(const UiContext& ui, const TimeModel& time, std::size_t shown, double tolerance_um, ImVec2 min,
                      ImVec2 max) {
  double low = tolerance_um, high = tolerance_um * 10.0;
  const auto include = [&](double um) {
    low = std::min(low, um);
    high = std::max(high, um);
  };
  for (const ErrorFan::Curve& curve : time.error_fan().curves()) {
    for (std::size_t i = 0; i < std::min(shown, curve.error_m.size()); ++i)
      include(shown_um(static_cast<double>(curve.error_m[i])));
  }
  for (const IterationRecord& r : time.tick().iterations()) include(shown_um(r));
  for (const IterationRecord& r : time.beside().iterations()) include(shown_um(r));
  return {min,
          max,
          std::pow(10.0, std::floor(std::log10(low) + 1e-9)),
          std::pow(10.0, std::ceil(std::log10(high) - 1e-9)),
          static_cast<double>(shown) - 1.0,
          ui.px(8)};
}

void draw_grid(const UiContext& ui, const ErrorScale& scale, double tolerance_um) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small_number;
  const auto width_of = [font](const std::string& s) {
    return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, s.c_str()).x;
  };
  draw.AddRectFilled(scale.min, scale.max, ui.colours.plot);
  for (const AxisTick& tick : log_ticks(scale.low, scale.high, 5)) {
    const float y = std::round(scale.y(tick.value));
    draw.AddLine({scale.min.x, y}, {scale.max.x, y}, tick.major ? ui.colours.grid : ui.colours.grid_minor);
    if (!tick.major) continue;
    draw.AddText(font, font->FontSize, {scale.min.x - ui.px(5) - width_of(tick.label), y - 0.5f * font->FontSize},
                 ui.colours.text_dim, tick.label.c_str());
  }
  for (const AxisTick& tick : linear_ticks(0.0, scale.last, 8)) {
    if (!tick.major || tick.value != std::floor(tick.value)) continue;
    const float x = std::round(scale.x(tick.value));
    draw.AddLine({x, scale.min.y}, {x, scale.max.y}, ui.colours.grid_minor);
    const std::string label = printed("%.0f", tick.value);
    draw.AddText(font, font->FontSize, {x - 0.5f * width_of(label), scale.max.y + ui.px(2)}, ui.colours.text_dim,
                 label.c_str());
  }
  draw_dashed_horizontal(draw, scale.min.x, scale.max.x, std::round(scale.y(tolerance_um)), ui.px(4),
                         ui.colours.text_dim, ui.px(1));
}

/// The iteration whose dot is under the mouse.
std::optional<std::size_t> under_mouse(const UiContext& ui, const ErrorScale& scale,
                                       std::span<const IterationRecord> iterations) {
  std::optional<std::size_t> nearest;
  float nearest_distance = ui.px(14);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const ImVec2 p = scale.point(i, iterations[i]);
    const float d = std::hypot(mouse.x - p.x, mouse.y - p.y);
    if (d >= nearest_distance) continue;
    nearest_distance = d;
    nearest = i;
  }
  return nearest;
}

/// Older ticks are fainter. Curves longer than the axis are cut off and marked. No line across a new seed, which starts
/// elsewhere.
void draw_fan(const UiContext& ui, const ErrorScale& scale, const ErrorFan& fan, std::size_t shown) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(scale.min, scale.max, true);
  const std::size_t count = fan.curves().size();
  for (std::size_t c = 0; c + 1 < count; ++c) {
    const ErrorFan::Curve& curve = fan.curves()[c];
    const ImU32 ink =
        packed(with_alpha(ui.palette.error, 0.06f + 0.16f * static_cast<float>(c + 1) / static_cast<float>(count)));
    for (std::size_t i = 1; i < std::min(shown + 1, curve.error_m.size()); ++i) {
      if (curve.seed[i] != curve.seed[i - 1]) continue;
      const auto at = [&](std::size_t k) {
        return ImVec2(scale.x(static_cast<double>(k)), scale.y(shown_um(static_cast<double>(curve.error_m[k]))));
      };
      draw.AddLine(at(i - 1), at(i), ink, ui.px(1));
    }
  }
  draw.PopClipRect();
  if (fan.longest() <= shown) return;
  const ImFont* font = ui.fonts.small;
  const std::string note = printed("faint: up to %zu", fan.longest() - 1);
  const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, note.c_str()).x;
  draw.AddText(font, font->FontSize, {scale.max.x - w - ui.px(4), scale.min.y + ui.px(2)}, ui.colours.text_dim,
               note.c_str());
}

/// The other preset's curve: hollow dots.
void draw_beside(const UiContext& ui, const ErrorScale& scale, std::span<const IterationRecord> iterations) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 ink = beside_ink(ui);
  for (std::size_t i = 1; i < iterations.size(); ++i) {
    if (iterations[i].seed != iterations[i - 1].seed) continue;
    draw.AddLine(scale.point(i - 1, iterations[i - 1]), scale.point(i, iterations[i]), ink, ui.px(1.3f));
  }
  const float radius = std::clamp(0.38f * (scale.x(1.0) - scale.x(0.0)), ui.px(1.6f), ui.px(4.0f));
  for (std::size_t i = 0; i < iterations.size(); ++i)
    draw.AddCircle(scale.point(i, iterations[i]), radius, ink, 16, ui.px(1.4f));
}

void draw_dots(const UiContext& ui, const ErrorScale& scale, std::span<const IterationRecord> iterations,
               std::optional<std::size_t> selected, std::optional<std::size_t> hovered) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float radius = std::clamp(0.38f * (scale.x(1.0) - scale.x(0.0)), ui.px(1.3f), ui.px(3.2f));
  for (std::size_t i = 1; i < iterations.size(); ++i) {
    // No line across a new seed, which starts elsewhere.
    if (iterations[i].seed != iterations[i - 1].seed) continue;
    draw.AddLine(scale.point(i - 1, iterations[i - 1]), scale.point(i, iterations[i]),
                 packed(with_alpha(ui.palette.error, 0.55f)), ui.px(1.3f));
  }
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const ImVec2 p = scale.point(i, iterations[i]);
    const bool marked = selected == i || hovered == i;
    draw.AddCircleFilled(p, marked ? ui.px(4.5f) : radius, packed(iteration_colour(i, iterations.size())), 16);
    if (marked) draw.AddCircle(p, ui.px(6.5f), ui.colours.text, 20, ui.px(1.2f));
  }
}

}  // namespace

void draw_error_plot(const UiContext& ui, AppModel& model) {
  const auto iterations = model.time().tick().iterations();
  const float width = ImGui::GetContentRegionAvail().x,
              height = std::clamp(0.16f * ImGui::GetWindowHeight(), ui.px(132), ui.px(220));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##error_plot", {std::max(width, 1.0f), height});
  ui.items.note_last("iterations/error_plot");
  const bool clicked = ImGui::IsItemClicked(), mouse_here = ImGui::IsItemHovered();
  const ImVec2 min{at.x + ui.px(40), at.y + ui.px(18)}, max{at.x + width - ui.px(6), at.y + height - ui.px(18)};
  if (max.x - min.x < ui.px(40)) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small;
  draw.AddText(font, font->FontSize, {min.x, at.y + ui.px(2)}, ui.colours.text, "Error");
  draw.AddText(font, font->FontSize, {min.x + ui.px(34), at.y + ui.px(2)}, ui.colours.text_dim,
               "\u00b5m, by iteration; faint: the 60 ticks before");
  const double tolerance_um = model.presets().current().solver.tolerance_m * 1e6;
  const auto beside = model.time().beside().iterations();
  const std::size_t shown = iterations_shown(std::max(iterations.size(), beside.size()),
                                             model.time().error_fan().longest(), model.time().paused());
  const ErrorScale scale = make_scale(ui, model.time(), shown, tolerance_um, min, max);
  draw_grid(ui, scale, tolerance_um);
  draw_fan(ui, scale, model.time().error_fan(), shown);
  const auto hovered = mouse_here ? under_mouse(ui, scale, iterations) : std::nullopt;
  draw_beside(ui, scale, beside);
  draw_dots(ui, scale, iterations, model.time().tick().selected(), hovered);
  if (!hovered) return;
  ImGui::SetTooltip("iteration %zu: %s \u00b5m", *hovered, short_number(iterations[*hovered].error_m * 1e6).c_str());
  if (!clicked) return;
  model.time().set_paused(true);
  model.time().tick().select(hovered);
}

}  // namespace tangent
