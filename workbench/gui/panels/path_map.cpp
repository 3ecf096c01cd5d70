// Path of a tick's iterations over (u, v): the base triangle in the plane, its neighbours unfolded, the residual
// |c - h N - S| as colour and contours, and the planes as dots in their usual colours. A path into a minimum converges,
// one around a minimum cycles, and one to where there is none diverges.
#include "workbench/gui/map/residual_map.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tangent {

namespace {

/// Maps flat coordinates to the screen: uniform scale, y up.
struct MapFraming {
  ImVec2 min, max;
  FlatView view;  ///< with the rectangle's aspect ratio

  ImVec2 at(const Vec2& p) const {
    const Vec2 share = (p - view.min) / view.size();
    return {min.x + static_cast<float>(share.x) * (max.x - min.x),
            max.y - static_cast<float>(share.y) * (max.y - min.y)};
  }
};

MapFraming fitted(const FlatView& wanted, ImVec2 min, ImVec2 max) {
  const double aspect = static_cast<double>((max.x - min.x) / (max.y - min.y));
  const Vec2 size = wanted.size(), middle = 0.5 * (wanted.min + wanted.max);
  const double height = std::max(size.y, size.x / aspect);
  const Vec2 half(0.5 * height * aspect, 0.5 * height);
  return {min, max, {middle - half, middle + half}};
}

/// The triangle of the selected plane, or else of the tick's contact.
std::uint32_t base_triangle(const TimeModel& time) {
  const auto iterations = time.tick().iterations();
  if (iterations.empty()) return kNone;
  return iterations[time.tick().selected().value_or(iterations.size() - 1)].triangle;
}

ImU32 field_ink(const UiContext& ui, float share) {
  const Rgba low = ui.palette.control_net, ground = ui.palette.panel;
  return packed(mix(low, ground, std::clamp(share, 0.0f, 1.0f)));
}

void draw_field(const UiContext& ui, const ResidualMap& map, const MapFraming& on, float low, float high) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const int columns = map.columns(), rows = map.rows();
  const auto node = [&](int c, int r) { return static_cast<std::size_t>(r * columns + c); };
  draw.PrimReserve(6 * (columns - 1) * (rows - 1), columns * rows);
  const auto first = static_cast<ImDrawIdx>(draw._VtxCurrentIdx);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Vec2 share(static_cast<double>(c) / (columns - 1), static_cast<double>(r) / (rows - 1));
      const float depth = (map.log_residuals()[node(c, r)] - low) / std::max(1e-3f, high - low);
      draw.PrimWriteVtx(on.at(on.view.min + share * on.view.size()), ImGui::GetIO().Fonts->TexUvWhitePixel,
                        field_ink(ui, 0.35f + 0.65f * depth));
    }
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const auto index = [&](int dc, int dr) {
        return static_cast<ImDrawIdx>(static_cast<std::size_t>(first) + node(c + dc, r + dr));
      };
      for (const ImDrawIdx i : {index(0, 0), index(1, 0), index(1, 1), index(0, 0), index(1, 1), index(0, 1)})
        draw.PrimWriteIdx(i);
    }
  }
}

std::string residual_text(double metres) {
  if (metres >= 1e-3) return printed("%g mm", metres * 1e3);
  if (metres >= 1e-6) return printed("%g \u00b5m", metres * 1e6);
  return printed("%g nm", metres * 1e9);
}

/// The labelled point of a contour: the lowest one clear of the planes' dots.
struct ContourLabel {
  int level = 0;
  ImVec2 at{0, 0};
  float merit = 0.0f;
};

float merit_of(const UiContext& ui, ImVec2 place, std::span<const ImVec2> planes) {
  float nearest = ui.px(40);
  for (const ImVec2& p : planes) nearest = std::min(nearest, std::hypot(p.x - place.x - ui.px(20), p.y - place.y));
  return nearest + 1e-3f * place.y;  // the lowest where all are clear
}

/// Whole decades are drawn stronger and labelled once.
void draw_contours(const UiContext& ui, const ResidualMap& map, const MapFraming& on, std::span<const ImVec2> planes) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 strong = packed(with_alpha(ui.palette.text, 0.38f)), weak = packed(with_alpha(ui.palette.text, 0.16f));
  std::vector<ContourLabel> labels;
  ImFont* font = ui.fonts.small_number;
  for (const ContourSegment& s : map.contours()) {
    const bool decade = s.level % 2 == 0;
    const ImVec2 a = on.at(s.a), b = on.at(s.b);
    draw.AddLine(a, b, decade ? strong : weak, ui.px(1));
    if (!decade) continue;
    const ImVec2 m{0.5f * (a.x + b.x), 0.5f * (a.y + b.y)};
    const bool room = m.x > on.min.x + ui.px(4) && m.x < on.max.x - ui.px(48) && m.y > on.min.y + ui.px(8) &&
                      m.y < on.max.y - ui.px(8);
    if (!room) continue;
    const float merit = merit_of(ui, m, planes);
    const auto known =
        std::find_if(labels.begin(), labels.end(), [&](const ContourLabel& l) { return l.level == s.level; });
    if (known == labels.end())
      labels.push_back({s.level, m, merit});
    else if (merit > known->merit)
      *known = {s.level, m, merit};
  }
  // Outer contours have more room: where two labels overlap the inner one is dropped.
  std::sort(labels.begin(), labels.end(),
            [](const ContourLabel& a, const ContourLabel& b) { return a.level > b.level; });
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto& [level, at, merit] = labels[i];
    const bool covered =
        std::any_of(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(i), [&](const ContourLabel& l) {
          return std::abs(l.at.y - at.y) < ui.px(13) && std::abs(l.at.x - at.x) < ui.px(46);
        });
    if (covered || merit < ui.px(16)) continue;
    const std::string text = residual_text(std::pow(10.0, level / 2));
    const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, text.c_str()).x;
    const ImVec2 p{at.x + ui.px(2), at.y - 0.5f * font->FontSize};
    draw.AddRectFilled({p.x - ui.px(2), p.y}, {p.x + w + ui.px(2), p.y + font->FontSize},
                       packed(with_alpha(ui.palette.panel, 0.7f)), ui.px(2));
    draw.AddText(font, font->FontSize, p, ui.colours.text_dim, text.c_str());
  }
}

void draw_edges(const UiContext& ui, const SceneModel& scene, const ResidualMap& map, const MapFraming& on) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ContactMesh& mesh = scene.current()->mesh();
  for (std::size_t i = map.triangles().size(); i-- > 0;) {
    const FlatTriangle& t = map.triangles()[i];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const EdgeKind kind = mesh.edge_kind(t.triangle, k);
      const Rgba colour = kind == EdgeKind::crease     ? ui.palette.crease
                          : kind == EdgeKind::boundary ? ui.palette.boundary
                                                       : ui.palette.text;
      draw.AddLine(on.at(t.corners[k]), on.at(t.corners[(k + 1) % 3]),
                   packed(with_alpha(colour, i == 0 ? 0.95f : 0.45f)), ui.px(i == 0 ? 1.6f : 1.0f));
    }
  }
  const char* names[3] = {"w", "u", "v"};
  const auto& base = map.triangles()[0].corners;
  const Vec2 middle = (base[0] + base[1] + base[2]) / 3.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const ImVec2 p = on.at(base[k] + 0.07 * (base[k] - middle));
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {p.x - ui.px(3), p.y - ui.px(7)}, ui.colours.text, names[k]);
  }
}

/// The planes of the other preset: hollow dots.
void draw_beside_path(const UiContext& ui, std::span<const IterationRecord> iterations, const ResidualMap& map,
                      const MapFraming& on) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 ink = beside_ink(ui);
  std::optional<ImVec2> last;
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const auto flat = map.place(iterations[i].triangle, iterations[i].u, iterations[i].v);
    const std::optional<ImVec2> here = flat ? std::optional(on.at(*flat)) : std::nullopt;
    if (here && last && iterations[i].seed == iterations[i - 1].seed) {
      draw.AddLine(*last, *here, packed(with_alpha(ui.palette.panel, 0.8f)), ui.px(3.5f));
      draw.AddLine(*last, *here, ink, ui.px(1.6f));
    }
    if (here) draw.AddCircle(*here, ui.px(5.2f), ink, 18, ui.px(1.6f));
    last = here;
  }
}

/// Returns the number of planes outside the map; `pointed`: the plane under the mouse.
std::size_t draw_path(const UiContext& ui, const TimeModel& time, const ResidualMap& map, const MapFraming& on,
                      bool mouse_here, std::optional<std::size_t>& pointed) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto iterations = time.tick().iterations();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  std::vector<std::optional<ImVec2>> points;
  std::size_t elsewhere = 0;
  float nearest = ui.px(10);
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const auto flat = map.place(iterations[i].triangle, iterations[i].u, iterations[i].v);
    if (!flat) ++elsewhere;
    points.push_back(flat ? std::optional(on.at(*flat)) : std::nullopt);
    if (!flat || !mouse_here) continue;
    const float d = std::hypot(mouse.x - points[i]->x, mouse.y - points[i]->y);
    if (d >= nearest) continue;
    nearest = d;
    pointed = i;
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!points[i] || !points[i - 1] || iterations[i].seed != iterations[i - 1].seed) continue;
    draw.AddLine(*points[i - 1], *points[i], packed(with_alpha(ui.palette.panel, 0.8f)), ui.px(3.5f));
    draw.AddLine(*points[i - 1], *points[i],
                 packed(mix(iteration_colour(i - 1, iterations.size()), ui.palette.text, 0.35f)), ui.px(1.6f));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i]) continue;
    const bool marked = time.tick().selected() == i || pointed == i;
    draw.AddCircleFilled(*points[i], ui.px(marked ? 5.5f : 4.2f), packed(ui.palette.panel), 16);
    draw.AddCircleFilled(*points[i], ui.px(marked ? 4.5f : 3.2f), packed(iteration_colour(i, iterations.size())), 16);
    if (marked) draw.AddCircle(*points[i], ui.px(7), ui.colours.text, 20, ui.px(1.2f));
  }
  return elsewhere;
}

void draw_heading(const UiContext& ui, const ResidualMap& map, const MapFraming& on, std::size_t elsewhere) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const double across = on.view.size().x;
  const std::string width = across >= 1e-3 ? printed("%.3g mm", across * 1e3) : printed("%.3g \u00b5m", across * 1e6);
  std::string text = printed("triangle %u, %s across", map.triangles()[0].triangle, width.c_str());
  if (elsewhere > 0) text += printed("; %zu plane%s elsewhere", elsewhere, elsewhere == 1 ? "" : "s");
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {on.min.x, on.max.y + ui.px(2)}, ui.colours.text_dim,
               text.c_str());
}

void draw_title(const UiContext& ui, PathMapPanel& state) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Path over (u, v)");
  tooltip(ui,
          "Where the planes touch the triangle, laid flat with its neighbours. Colour and contours: the residual |c - "
          "h N - S| that a plane there would leave");
  ImGui::SameLine();
  ImGui::TextDisabled("|c \u2212 hN \u2212 S|");
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ui.px(98));
  bool path = state.close_up, triangle = !state.close_up;
  if (toggle_button(ui, "iterations/map_path", "Path", path, "Zooms to the path")) state.close_up = true;
  ImGui::SameLine(0, ui.px(3));
  if (toggle_button(ui, "iterations/map_triangle", "Triangle", triangle, "Shows the whole base triangle"))
    state.close_up = false;
  ImGui::PopFont();
}

}  // namespace

void draw_path_map(const UiContext& ui, AppModel& model, PathMapPanel& state) {
  draw_title(ui, state);

  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x - ui.px(4)),
              height = std::clamp(0.22f * ImGui::GetWindowHeight(), ui.px(196), ui.px(320));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##path_map", {width, height + ui.px(18)});
  ui.items.note_last("iterations/path_map");
  const bool clicked = ImGui::IsItemClicked(), mouse_here = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end{at.x + width, at.y + height};
  const std::uint32_t triangle_index = base_triangle(model.time());
  const ServoRecord* record = model.time().tick().record();
  const bool there = record != nullptr && model.scene().current() != nullptr &&
                     triangle_index < model.scene().current()->mesh().triangle_count() && width > ui.px(60) &&
                     model.time().scene_of_tick() == model.scene().current() &&
                     model.scene().current()->mesh().usable(triangle_index) &&
                     is_finite(record->tick.input.finger.position);
  draw.AddRectFilled(at, end, ui.colours.plot);
  if (!there) {
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {at.x + ui.px(8), at.y + ui.px(8)}, ui.colours.text_faint,
                 "no planes on this mesh");
    return;
  }
  const Preset* then = model.time().preset_of_tick();
  const Preset& preset = then != nullptr ? *then : model.presets().current();
  ResidualMap map(model.scene().current(), triangle_index, preset.finger, preset.solver.normal_form,
                  record->tick.input);
  const MapFraming on =
      fitted(state.close_up ? map.path_view(model.time().tick().iterations()) : map.whole_view(), at, end);
  map.sample(on.view, 61, 39);
  const auto [low, high] = std::minmax_element(map.log_residuals().begin(), map.log_residuals().end());
  draw.PushClipRect(at, end, true);
  draw_field(ui, map, on, *low, *high);
  std::vector<ImVec2> planes;
  for (const IterationRecord& r : model.time().tick().iterations()) {
    if (const auto flat = map.place(r.triangle, r.u, r.v)) planes.push_back(on.at(*flat));
  }
  draw_contours(ui, map, on, planes);
  draw_edges(ui, model.scene(), map, on);
  std::optional<std::size_t> pointed;
  draw_beside_path(ui, model.time().beside().iterations(), map, on);
  const std::size_t elsewhere = draw_path(ui, model.time(), map, on, mouse_here, pointed);
  draw.PopClipRect();
  draw_heading(ui, map, on, elsewhere);
  if (!pointed) return;
  ImGui::SetTooltip("iteration %zu: %s \u00b5m", *pointed,
                    short_number(model.time().tick().iterations()[*pointed].error_m * 1e6).c_str());
  if (!clicked) return;
  model.time().set_paused(true);
  model.time().tick().select(pointed);
}

}  // namespace tangent
