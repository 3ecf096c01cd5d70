// X-Y plot, spectrum and histogram of the ticks in view. Counts are exact; large ranges are counted over several
// frames.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/plots/axes_drawing.h"
#include "workbench/gui/plots/tick_locator.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr std::uint64_t kMostJoined = 8000;  ///< ticks: up to this many are drawn as a polyline
constexpr double kSpectrumEvery_s = 0.2;
/// Motion and tremor of the hand are below this frequency; above it is the loop.
constexpr double kHandUpTo_hz = 20.0;

PlainAxis axis_over(const MinMax& range, double scale, std::string label) {
  PlainAxis axis{0.0, 1.0, false, std::move(label)};
  if (range.empty()) return axis;
  axis.low = static_cast<double>(range.min) * scale;
  axis.high = static_cast<double>(range.max) * scale;
  widen_to_nice(axis.low, axis.high, 12);
  return axis;
}

void say_empty(const UiContext& ui, const PlotArea& area, const char* text) {
  ImFont* font = ui.fonts.small;
  text_at(*ImGui::GetWindowDrawList(), font,
          {0.5f * (area.min.x + area.max.x - text_width(font, text)), 0.5f * (area.min.y + area.max.y)},
          ui.colours.text_faint, text);
}

/// Choice of the curve.
void draw_choice(const UiContext& ui, const char* path, const char* label, const std::vector<PlotSeries>& curves,
                 std::string& key, float width) {
  std::vector<std::string> names;
  int chosen = 0;
  for (const PlotSeries& curve : curves) {
    if (curve.key == key) chosen = static_cast<int>(names.size());
    names.push_back(curve.full_name);
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(0, ui.px(5));
  choice_row(ui, path, width, views, chosen);
  key = curves[static_cast<std::size_t>(chosen)].key;
  ImGui::SameLine(0, ui.px(12));
}

/// The ghost's counts as a line over the recorded bars.
void draw_ghost_outline(const UiContext& ui, const SampleCells& ghost, const PlainPlot& plot, const PlotSeries& curve) {
  const double low = static_cast<double>(ghost.x_range().min) * curve.scale,
               high = static_cast<double>(ghost.x_range().max) * curve.scale;
  const double cell = (high - low) / static_cast<double>(ghost.query().columns);
  std::vector<ImVec2> line{plot.at(low, 0.0)};
  for (std::size_t i = 0; i < ghost.query().columns; ++i) {
    const double x = low + cell * static_cast<double>(i), count = static_cast<double>(ghost.counts()[i]);
    line.push_back(plot.at(x, count));
    line.push_back(plot.at(x + cell, count));
  }
  line.push_back(plot.at(high, 0.0));
  ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()), ghost_ink(ui, curve), 0,
                                          ui.px(1.3f));
}

void draw_histogram(const UiContext& ui, TimeModel& time, PlotsPanel& state, const PlotSeries& curve,
                    const PlotArea& area) {
  const auto [from, to] = ticks_in_view(time);
  const CellQuery wanted{curve.channel, std::nullopt, from, to, 96, 1, curve.key};
  state.cells.update(curve.store_in(time.store()), wanted);
  const SampleCells& cells = state.cells;
  const bool mine = cells.query().of == curve.key && !cells.query().y && !cells.counts().empty();
  const ChannelStore* again = curve.ghost_in(state.link.ghost);
  if (again != nullptr)
    state.ghost_cells.update(*again, {curve.ghost.value_or(0), std::nullopt, from, to, 96, 1, curve.key});
  const SampleCells& ghost = state.ghost_cells;
  const bool ghost_mine = again != nullptr && ghost.query().of == curve.key && !ghost.counts().empty();
  MinMax x_range = mine ? cells.x_range() : MinMax{};
  if (ghost_mine) x_range.include(ghost.x_range());
  PlainPlot plot{area, axis_over(x_range, curve.scale, with_unit(curve)), {0.0, 1.0, false, "Ticks"}};
  if (mine && cells.most() > 0) {
    plot.y.high = static_cast<double>(std::max(cells.most(), ghost_mine ? ghost.most() : 0u));
    widen_to_nice(plot.y.low, plot.y.high, 4);
    plot.y.label = printed("Ticks, of %llu", static_cast<unsigned long long>(cells.total()));
  }
  draw_axes(ui, plot);
  if (!mine || cells.total() == 0) {
    say_empty(ui, area, "no samples in view");
    return;
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(area.min, area.max, true);
  const double low = static_cast<double>(cells.x_range().min) * curve.scale,
               high = static_cast<double>(cells.x_range().max) * curve.scale;
  const double cell = (high - low) / static_cast<double>(cells.query().columns);
  for (std::size_t i = 0; i < cells.query().columns; ++i) {
    if (cells.counts()[i] == 0) continue;
    const double x = low + cell * static_cast<double>(i);
    ImVec2 a = plot.at(x, static_cast<double>(cells.counts()[i])), b = plot.at(x + cell, 0.0);
    b.x = std::max(b.x - ui.px(1), a.x + ui.px(1));
    a.y = std::min(a.y, b.y - ui.px(1));  // a single sample among a million stays visible
    draw.AddRectFilled(a, b, packed(ui.palette.*curve.colour));
  }
  if (ghost_mine && ghost.total() > 0) draw_ghost_outline(ui, ghost, plot, curve);
  draw.PopClipRect();
}

void draw_spectrum(const UiContext& ui, AppModel& model, PlotsPanel& state, const PlotSeries& curve,
                   const PlotArea& area) {
  const auto [from, to] = ticks_in_view(model.time());
  const ChannelStore* again = curve.ghost_in(state.link.ghost);
  const bool with_ghost = again != nullptr;
  const std::uint64_t ghost = with_ghost ? again->generation() : 0;
  const double rate_hz = 1.0 / model.time().tick_period_s();
  const bool other = state.spectrum_of != state.x || state.spectrum_from != from || state.spectrum_to != to ||
                     state.spectrum_ghost != ghost;
  if (other && (state.spectrum_of != state.x || std::abs(model.now_s() - state.spectrum_at_s) >= kSpectrumEvery_s)) {
    state.spectrum = amplitude_spectrum(curve.store_in(model.time().store()), curve.channel, from, to, rate_hz);
    state.ghost_spectrum =
        with_ghost ? amplitude_spectrum(*again, curve.ghost.value_or(0), from, to, rate_hz) : Spectrum{};
    state.spectrum_ghost = ghost;
    state.spectrum_of = state.x;
    state.spectrum_from = from;
    state.spectrum_to = to;
    state.spectrum_at_s = model.now_s();
  }
  const Spectrum& s = state.spectrum;
  PlainPlot plot{area, {1.0, 500.0, true, "Hz"}, {1e-6, 1.0, true, "Amplitude of " + with_unit(curve)}};
  if (!s.empty() && s.peak > 0) {
    const double scale = curve.scale;
    plot.x.low = s.bin_hz;
    plot.x.high = s.bin_hz * static_cast<double>(s.amplitude.size() - 1);
    plot.y.high = std::pow(10.0, std::ceil(std::log10(static_cast<double>(s.amplitude[s.peak]) * scale) + 0.05));
    plot.y.low = plot.y.high * 1e-6;
    const char* unit = curve.unit.c_str();
    plot.y.label +=
        printed(": largest %.3g %s at %.4g Hz", static_cast<double>(s.amplitude[s.peak]) * scale, unit, s.peak_hz());
    if (const std::size_t buzz = s.peak_above(kHandUpTo_hz); buzz > 0 && buzz != s.peak)
      plot.y.label +=
          printed("; above %.0f Hz, where no hand moves: %.3g %s at %.4g Hz", kHandUpTo_hz,
                  static_cast<double>(s.amplitude[buzz]) * scale, unit, s.bin_hz * static_cast<double>(buzz));
    plot.y.label +=
        printed("   (mean of %zu segment%s of %zu ticks)", s.segments, s.segments == 1 ? "" : "s", s.segment_ticks);
  }
  draw_axes(ui, plot);
  if (s.empty() || s.peak == 0) {
    say_empty(ui, area, "64 ticks without a gap are needed, and something that moves");
    return;
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(area.min, area.max, true);
  const auto line_of = [&](const Spectrum& of) {
    std::vector<ImVec2> points;
    for (std::size_t i = 1; i < of.amplitude.size(); ++i) {
      const double value = std::max(static_cast<double>(of.amplitude[i]) * curve.scale, plot.y.low * 0.1);
      points.push_back(plot.at(of.bin_hz * static_cast<double>(i), value));
    }
    return points;
  };
  const std::vector<ImVec2> line = line_of(s);
  draw.AddPolyline(line.data(), static_cast<int>(line.size()), packed(ui.palette.*curve.colour), 0, ui.px(1.3f));
  if (with_ghost) {
    const std::vector<ImVec2> other_line = line_of(state.ghost_spectrum);
    draw.AddPolyline(other_line.data(), static_cast<int>(other_line.size()), ghost_ink(ui, curve), 0, ui.px(1.0f));
  }
  for (const std::size_t peak : {s.peak, s.peak_above(kHandUpTo_hz)}) {
    if (peak > 0) draw.AddCircle(line[peak - 1], ui.px(5), ui.colours.text, 20, ui.px(1.2f));
  }
  draw.PopClipRect();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (!ImGui::IsMouseHoveringRect(area.min, area.max)) return;
  const double hz = plot.x.value_at(static_cast<double>((mouse.x - area.min.x) / area.width()));
  const auto bin =
      std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(hz / s.bin_hz)), 1, s.amplitude.size() - 1);
  ImGui::SetTooltip("%.4g Hz: %.4g %s", s.bin_hz * static_cast<double>(bin),
                    static_cast<double>(s.amplitude[bin]) * curve.scale, curve.unit.c_str());
}

void draw_xy(const UiContext& ui, TimeModel& time, PlotsPanel& state, const PlotSeries& cx, const PlotSeries& cy,
             const PlotArea& area) {
  const auto [from, to] = ticks_in_view(time);
  const ChannelStore &across = cx.store_in(time.store()), &up = cy.store_in(time.store());
  const double sx = cx.scale, sy = cy.scale;
  PlainPlot plot{area, axis_over(across.min_max(cx.channel, from, to), sx, with_unit(cx)),
                 axis_over(up.min_max(cy.channel, from, to), sy, with_unit(cy))};
  const bool joined = to - from <= kMostJoined;
  const std::string of = cx.key + " " + cy.key;
  if (!joined) state.cells.update(across, {cx.channel, cy.channel, from, to, 192, 108, of}, &up);
  draw_axes(ui, plot);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(area.min, area.max, true);
  const Rgba ink = ui.palette.*cy.colour;
  if (joined) {
    std::optional<ImVec2> before;
    for (std::uint64_t tick = from; tick < to; ++tick) {
      const float x = across.value(cx.channel, tick), y = up.value(cy.channel, tick);
      if (std::isnan(x) || std::isnan(y)) {
        before.reset();
        continue;
      }
      const ImVec2 p = plot.at(static_cast<double>(x) * sx, static_cast<double>(y) * sy);
      const float age = static_cast<float>(tick - from) / static_cast<float>(std::max<std::uint64_t>(1, to - from));
      if (before) draw.AddLine(*before, p, packed(with_alpha(ink, 0.25f + 0.75f * age)), ui.px(1.3f));
      before = p;
    }
  } else if (state.cells.query().of == of && !state.cells.counts().empty()) {
    const SampleCells& cells = state.cells;
    const std::size_t columns = cells.query().columns, rows = cells.query().rows;
    const auto place = [&](const MinMax& range, double share) {
      return static_cast<double>(range.min) + share * static_cast<double>(range.max - range.min);
    };
    for (std::size_t i = 0; i < cells.counts().size(); ++i) {
      if (cells.counts()[i] == 0) continue;
      const double c = static_cast<double>(i % columns), r = static_cast<double>(i / columns);
      const ImVec2 a = plot.at(sx * place(cells.x_range(), c / static_cast<double>(columns)),
                               sy * place(cells.y_range(), (r + 1.0) / static_cast<double>(rows)));
      const ImVec2 b = plot.at(sx * place(cells.x_range(), (c + 1.0) / static_cast<double>(columns)),
                               sy * place(cells.y_range(), r / static_cast<double>(rows)));
      const float share =
          std::log1p(static_cast<float>(cells.counts()[i])) / std::log1p(static_cast<float>(cells.most()));
      draw.AddRectFilled(a, {std::max(b.x, a.x + 1.0f), std::max(b.y, a.y + 1.0f)},
                         packed(with_alpha(ink, 0.2f + 0.8f * share)));
    }
  }
  const ServoRecord* record = time.tick().record();
  if (record != nullptr) {
    const float x = across.value(cx.channel, record->tick.tick), y = up.value(cy.channel, record->tick.tick);
    if (!std::isnan(x) && !std::isnan(y))
      draw.AddCircle(plot.at(static_cast<double>(x) * sx, static_cast<double>(y) * sy), ui.px(5), ui.colours.accent, 20,
                     ui.px(1.8f));
  }
  draw.PopClipRect();
  if (across.min_max(cx.channel, from, to).empty() || up.min_max(cy.channel, from, to).empty())
    say_empty(ui, area, "no samples in view");
}

}  // namespace

void draw_other_plot(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect) {
  ImGui::SetCursorScreenPos({rect.x, rect.y});
  ImGui::BeginChild("other_plot", {rect.w, rect.h}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(6), ui.px(2)));
  ImGui::SetCursorScreenPos({rect.x + ui.px(8), rect.y + ui.px(2)});
  const bool xy = state.mode == PlotsMode::xy;
  draw_choice(ui, "plots/curve_x", xy ? "Across" : "Curve", state.curves, state.x, ui.px(170));
  if (xy) draw_choice(ui, "plots/curve_y", "Up", state.curves, state.y, ui.px(170));
  const float used = ImGui::GetFrameHeight() + ui.px(4);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  const PlotArea area = plain_area(ui, {rect.x, rect.y + used}, {rect.w, rect.h - used});
  if (area.width() > ui.px(40) && area.height() > ui.px(20)) {
    const PlotSeries& x = curve_of(state, state.x);
    if (state.mode == PlotsMode::histogram)
      draw_histogram(ui, model.time(), state, x, area);
    else if (state.mode == PlotsMode::spectrum)
      draw_spectrum(ui, model, state, x, area);
    else
      draw_xy(ui, model.time(), state, x, curve_of(state, state.y), area);
  }
  ImGui::EndChild();
  ui.items.note("plots/other", area.min, area.max);
}

}  // namespace tangent
