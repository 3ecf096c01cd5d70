#include "workbench/gui/panels/curves_plot.h"

#include "workbench/bench/speed_curves.h"
#include "workbench/gui/panels/curves_text.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

using bench::CurvePeer;
using bench::CurvePoint;
using bench::SpeedCurves;

constexpr double kLeastError_m = 1e-15;  // smaller errors are drawn there

double error_of(const Distribution& d, CurvesModel::Error which) {
  switch (which) {
    case CurvesModel::Error::p50:
      return d.p50;
    case CurvesModel::Error::p99:
      return d.p99;
    case CurvesModel::Error::worst:
      break;
  }
  return d.max;
}

const MedianInterval& time_of(const bench::TickTimes& t, CurvesModel::Time which) {
  switch (which) {
    case CurvesModel::Time::p50:
      return t.p50_ns;
    case CurvesModel::Time::mean:
      return t.mean_ns;
    case CurvesModel::Time::p99:
      break;
  }
  return t.p99_ns;
}

/// A logarithmic axis over whole decades.
struct Decades {
  int from = 0, to = 1;  ///< powers of ten

  void include(double value) {
    const double power = std::log10(value);
    if (to < from) from = to = static_cast<int>(std::floor(power));
    from = std::min(from, static_cast<int>(std::floor(power)));
    to = std::max({to, static_cast<int>(std::ceil(power)), from + 1});
  }
  float share(double value) const {
    return static_cast<float>((std::log10(value) - from) / static_cast<double>(to - from));
  }
};

/// Where a point or peer is drawn.
struct DrawnPoint {
  ImVec2 at;
  float low_y = 0.0f, high_y = 0.0f;  ///< of the time's interval
};

struct CurvesArea {
  ImVec2 min, max;
  Decades error{0, -1}, time{0, -1};

  float x(double error_m) const { return min.x + error.share(std::max(error_m, kLeastError_m)) * (max.x - min.x); }
  float y(double ns) const { return max.y - time.share(std::max(ns, 0.1)) * (max.y - min.y); }
  DrawnPoint place(double error_m, const MedianInterval& t) const {
    return {{x(error_m), y(t.median)}, y(t.low), y(t.high)};
  }
};

ImU32 peer_ink(const UiContext& ui) { return ui.colours.text_dim; }

void draw_peer_marker(const UiContext& ui, ImVec2 at, float r) {
  ImGui::GetWindowDrawList()->AddQuad({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y},
                                      peer_ink(ui), ui.px(1.3f));
}

/// All points of the curves, then of the peers; without an error or a time, none.
std::vector<std::optional<DrawnPoint>> drawn_points(const CurvesModel& model, const SpeedCurves& curves,
                                                    CurvesArea& area) {
  const auto each = [&](const auto& act) {
    for (const CurvePoint& p : curves.points)
      act(p.errors.error_m.count > 0 ? &p.errors.error_m : nullptr, time_of(p.times, model.shown_time));
    for (const CurvePeer& p : curves.peers)
      act(p.error_m && p.error_m->count > 0 ? &*p.error_m : nullptr, time_of(p.times, model.shown_time));
  };
  each([&](const Distribution* d, const MedianInterval& t) {
    if (d == nullptr) return;
    area.error.include(std::max(error_of(*d, model.shown_error), kLeastError_m));
    for (const double ns : {t.low, t.high}) area.time.include(std::max(ns, 0.1));
  });
  std::vector<std::optional<DrawnPoint>> out;
  each([&](const Distribution* d, const MedianInterval& t) {
    out.push_back(d != nullptr ? std::optional(area.place(error_of(*d, model.shown_error), t)) : std::nullopt);
  });
  return out;
}

/// Lines at every decade; labels as far apart as they have room.
void draw_curve_axes(const UiContext& ui, const CurvesArea& area) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small_number;
  const auto width = [font](const std::string& s) {
    return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, s.c_str()).x;
  };
  float free_from = area.min.x - ui.px(30);
  for (int k = area.error.from; k <= area.error.to; ++k) {
    const float x = std::round(area.x(std::pow(10.0, k)));
    draw.AddLine({x, area.min.y}, {x, area.max.y}, ui.colours.grid_minor);
    const std::string label = length_in_unit(std::pow(10.0, k));
    const float w = width(label), left = std::clamp(x - 0.5f * w, area.min.x - ui.px(2), area.max.x - w + ui.px(4));
    if (left < free_from) continue;
    draw.AddText(font, font->FontSize, {left, area.max.y + ui.px(3)}, ui.colours.text_dim, label.c_str());
    free_from = left + w + ui.px(8);
  }
  for (int k = area.time.from; k <= area.time.to; ++k) {
    const float y = std::round(area.y(std::pow(10.0, k)));
    draw.AddLine({area.min.x, y}, {area.max.x, y}, ui.colours.grid_minor);
    const std::string label = time_in_unit(std::pow(10.0, k));
    draw.AddText(font, font->FontSize, {area.min.x - width(label) - ui.px(5), y - 0.5f * font->FontSize},
                 ui.colours.text_dim, label.c_str());
  }
}

/// A line through the tolerances, a broken one through the limits.
void draw_lines(const UiContext& ui, const SpeedCurves& curves, std::span<const std::optional<DrawnPoint>> places) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t i = 1; i < curves.points.size(); ++i) {
    const bench::CurveSetting &a = curves.points[i - 1].setting, &b = curves.points[i].setting;
    if (a.method != b.method || a.swept != b.swept || b.swept == bench::Swept::nothing) continue;
    if (!places[i - 1] || !places[i]) continue;
    const ImVec2 from = places[i - 1]->at, to = places[i]->at;
    const ImU32 ink = method_ink(ui, b.method);
    if (b.swept == bench::Swept::tolerance) {
      draw.AddLine(from, to, ink, ui.px(1.5f));
      continue;
    }
    const float length = std::hypot(to.x - from.x, to.y - from.y), dash = ui.px(4);
    for (float at = 0.0f; at < length; at += 2.0f * dash) {
      const float s = at / length, e = std::min(1.0f, (at + dash) / length);
      draw.AddLine({from.x + s * (to.x - from.x), from.y + s * (to.y - from.y)},
                   {from.x + e * (to.x - from.x), from.y + e * (to.y - from.y)}, ink, ui.px(1.0f));
    }
  }
}

void draw_points(const UiContext& ui, const SpeedCurves& curves, std::span<const std::optional<DrawnPoint>> places) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    const bool peer = i >= curves.points.size();
    const ImU32 ink = peer ? peer_ink(ui) : method_ink(ui, curves.points[i].setting.method);
    const auto [at, low, high] = *places[i];
    draw.AddLine({at.x, low}, {at.x, high}, ink, ui.px(1.0f));
    for (const float y : {low, high}) draw.AddLine({at.x - ui.px(2.5f), y}, {at.x + ui.px(2.5f), y}, ink, ui.px(1.0f));
    if (peer) {
      draw_peer_marker(ui, at, ui.px(4));
      continue;
    }
    draw_method_marker(ui, curves.points[i].setting.method, at, ui.px(2.6f));
    if (curves.points[i].setting.swept == bench::Swept::nothing)
      draw.AddCircle(at, ui.px(5.5f), ui.colours.text, 20, ui.px(1.2f));
  }
}

std::optional<std::size_t> point_at_mouse(const UiContext& ui, std::span<const std::optional<DrawnPoint>> places) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  std::optional<std::size_t> found;
  float least = ui.px(14);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    const float d = std::hypot(mouse.x - places[i]->at.x, mouse.y - places[i]->at.y);
    if (d >= least) continue;
    least = d;
    found = i;
  }
  return found;
}

}  // namespace

// Okabe & Ito's hues as the theme has them; the shape tells methods apart where hues don't.
ImU32 method_ink(const UiContext& ui, Method method) {
  const Palette& p = ui.palette;
  const std::array inks{p.force_x, p.force_z, p.force_y, p.force_magnitude, p.cld_measured, p.cld_commanded};
  return packed(inks[static_cast<std::size_t>(method)]);
}

void draw_method_marker(const UiContext& ui, Method method, ImVec2 at, float r) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 ink = method_ink(ui, method);
  switch (method) {
    case Method::paper:
      return draw.AddCircleFilled(at, r, ink, 14);
    case Method::newton:
      return draw.AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, ink);
    case Method::robust:
      return draw.AddTriangleFilled({at.x, at.y - 1.2f * r}, {at.x + 1.1f * r, at.y + r}, {at.x - 1.1f * r, at.y + r},
                                    ink);
    case Method::facet:
      return draw.AddRect({at.x - r, at.y - r}, {at.x + r, at.y + r}, ink, 0.0f, 0, ui.px(1.4f));
    case Method::force_shading:
      return draw.AddCircle(at, r, ink, 14, ui.px(1.4f));
    case Method::two_pass:
      return draw.AddTriangle({at.x, at.y - 1.2f * r}, {at.x + 1.1f * r, at.y + r}, {at.x - 1.1f * r, at.y + r}, ink,
                              ui.px(1.4f));
  }
}

void draw_curves_plot(const UiContext& ui, AppModel& model, const SpeedCurves& curves) {
  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x), height = ui.px(220);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##speed_plot", {width, height});
  ui.items.note_last("speed/plot");
  const bool here = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  CurvesArea area{{at.x + ui.px(44), at.y + ui.px(8)}, {at.x + width - ui.px(8), at.y + height - ui.px(18)}};
  if (area.max.x - area.min.x < ui.px(40)) return;
  ImGui::GetWindowDrawList()->AddRectFilled(area.min, area.max, ui.colours.plot);
  const auto places = drawn_points(model.curves(), curves, area);
  draw_curve_axes(ui, area);
  draw_lines(ui, curves, places);
  draw_points(ui, curves, places);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i])
      ui.items.note(printed("speed/point/%zu", i + 1), {places[i]->at.x - 1.0f, places[i]->at.y - 1.0f},
                    {places[i]->at.x + 1.0f, places[i]->at.y + 1.0f});
  const auto pointed = here ? point_at_mouse(ui, places) : std::nullopt;
  if (!pointed) return;
  ImGui::GetWindowDrawList()->AddCircle(places[*pointed]->at, ui.px(7.5f), ui.colours.accent, 20, ui.px(1.5f));
  const std::string text = *pointed < curves.points.size()
                               ? curve_point_text(curves.points[*pointed])
                               : curve_peer_text(curves.peers[*pointed - curves.points.size()]);
  const auto tick = model.curves().worst_tick(*pointed);
  ImGui::SetTooltip("%zu: %s\nClick: open its worst tick%s", *pointed + 1, text.c_str(),
                    tick ? printed(", %llu", static_cast<unsigned long long>(*tick)).c_str() : "");
  if (clicked) open_curve_point(model, *pointed);
}

}  // namespace tangent
