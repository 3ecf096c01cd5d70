#include "workbench/gui/panels/planar_view.h"

#include "workbench/gui/layout/view_room.h"
#include "workbench/gui/render/force_arrows.h"
#include "workbench/gui/render/overlay_canvas.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>
#include <vector>

namespace tangent {

namespace {

constexpr double kForceScale = 0.006;                   // m of arrow per N
constexpr double kInsetLeft = 0.6, kInsetBottom = 0.7;  // em, from the view's corner
constexpr float kScaleHeight = 44.0f;                   // points, over the inset
constexpr std::size_t kMostPatchesNamed = 5000;         // beyond, only the polygon and the curve are drawn

struct PlanarToggle {
  const char* name;
  bool PlanarView::*on;
  const char* doc;
};
constexpr std::array kToggles{
    PlanarToggle{"Patches", &PlanarView::patches, "One per vertex: between its control polygon and the curve"},
    PlanarToggle{"Polygon", &PlanarView::polygon, "The polygon as it is"},
    PlanarToggle{"Curve", &PlanarView::curve, "The smooth curve that is rendered"},
    PlanarToggle{"Centres", &PlanarView::centres,
                 "Local centres with the angles of their patches: the tracked patch's, and small ones of all"},
    PlanarToggle{"Tangents", &PlanarView::tangents, "Tangent lines of the tick's iterations, coloured by order"},
    PlanarToggle{"Finger", &PlanarView::finger, "The finger, with its contact"},
    PlanarToggle{"Force", &PlanarView::force,
                 "The computed force, and the felt one behind the safety gate, 6 mm per newton"},
    PlanarToggle{"Display", &PlanarView::display, "The fingerpad from the side, with the roller where it is"}};

/// Maps the scene to pixels and back; y up.
class Paper {
 public:
  Paper(const PlanarView& view, const Rect& rect)
      : view_(view), middle_{rect.x + 0.5f * rect.w, rect.y + 0.5f * rect.h} {}
  ImVec2 at(const Vec2& world) const {
    const Vec2 d = view_.px_per_m * (world - view_.centre);
    return {middle_.x + static_cast<float>(d.x), middle_.y - static_cast<float>(d.y)};
  }
  ImVec2 at(const Vec3& world) const { return at(Vec2(world.x, world.y)); }
  Vec2 world(ImVec2 pixel) const {
    return view_.centre +
           Vec2(static_cast<double>(pixel.x - middle_.x), static_cast<double>(middle_.y - pixel.y)) / view_.px_per_m;
  }
  float length(double metres) const { return static_cast<float>(metres * view_.px_per_m); }

 private:
  const PlanarView& view_;
  ImVec2 middle_;
};

/// Frames the whole polygon and a finger, clear of cards and bars.
void frame_all(const UiContext& ui, const AppModel& model, PlanarView& view, const Rect& rect) {
  const Box& box = model.scene().current()->mesh().bounds();
  const Vec3 origin = model.scene().current()->mesh().origin(), size = box.size();
  // The whole finger on every side.
  const double reach = 4.2 * model.presets().current().finger.reach_m();
  const double em = ui.fonts.text->FontSize, height = rect.h;
  const Vec2 card{(kInsetLeft + kInsetWidth + 1.0) * em,
                  ui.px(kScaleHeight) + (view.display ? (kInsetBottom + kInsetHeight) * em : 0.0)};
  view.px_per_m = 0.0;
  for (const ViewRoom& room : rooms_beside({rect.w, rect.h}, ui.px(34), ui.px(8), card)) {
    const double px_per_m = 0.94 * height * std::min(room.width / (size.x + reach), room.height / (size.y + reach));
    if (px_per_m <= view.px_per_m) continue;
    view.px_per_m = px_per_m;
    view.centre = Vec2(origin.x, origin.y) - room.shift * height / px_per_m;
  }
  view.framed = model.scene().current().get();
  view.framings = model.view().framings;
}

void interact(DeviceModel& devices, PlanarView& view, const Rect& rect) {
  const ImGuiIO& io = ImGui::GetIO();
  const Paper paper(view, rect);
  const bool leading = devices.hand_follows_mouse() && !io.KeyShift;
  if (ImGui::IsItemActive() && leading && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    const Vec2 at = paper.world(io.MousePos);
    devices.lead_hand({at.x, at.y, 0.0});
  } else if (ImGui::IsItemActive()) {
    view.centre -= Vec2(static_cast<double>(io.MouseDelta.x), -static_cast<double>(io.MouseDelta.y)) / view.px_per_m;
  }
  if (!ImGui::IsItemHovered() || io.MouseWheel == 0.0f) return;
  const Vec2 held = paper.world(io.MousePos);
  const double factor = std::pow(0.86, -static_cast<double>(io.MouseWheel));
  view.px_per_m = std::clamp(view.px_per_m * factor, 1.0, 1e9);
  view.centre = held + (view.centre - held) / factor;
}

/// Points along a patch of the rendered curve, dense enough to look smooth.
std::vector<ImVec2> curve_points(const PlanarCurve& curve, std::uint32_t patch, LocalCentre kind, const Paper& paper) {
  const CurvePatch& p = curve.patch(patch);
  const float reach = paper.length(glm::length(p.last - p.first));
  const int steps = p.straight ? 1 : std::clamp(static_cast<int>(reach / 6.0f), 4, 64);
  std::vector<ImVec2> points;
  for (int k = 0; k <= steps; ++k)
    points.push_back(paper.at(curve.origin() + curve.sample(patch, kind, static_cast<double>(k) / steps).place));
  return points;
}

void draw_curve(const UiContext& ui, const PlanarView& view, const PlanarCurve& curve, LocalCentre kind,
                const Paper& paper, ImDrawList& draw) {
  const Palette& c = ui.palette;
  const bool detail = curve.patch_count() <= kMostPatchesNamed;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    const CurvePatch& p = curve.patch(i);
    const std::vector<ImVec2> points = curve_points(curve, i, kind, paper);
    if (view.patches && detail && !p.straight) {
      // A triangle fan from the vertex: the region may be concave.
      const ImU32 fill = colour(i % 2 ? c.control_net : c.smooth_surface, 0.28f);
      const ImVec2 vertex = paper.at(curve.origin() + p.vertex);
      // Without anti-aliasing, which would show seams between neighbours.
      const ImDrawListFlags flags = draw.Flags;
      draw.Flags &= ~ImDrawListFlags_AntiAliasedFill;
      for (std::size_t k = 0; k + 1 < points.size(); ++k)
        draw.AddTriangleFilled(vertex, points[k], points[k + 1], fill);
      draw.Flags = flags;
    }
    if (view.polygon && p.joint_after == CurveJoint::smooth) {
      const ImVec2 a = paper.at(curve.origin() + p.vertex), b = paper.at(curve.origin() + curve.vertex(curve.after(i)));
      draw.AddLine(a, b, colour(c.mesh), ui.px(1.2f));
    }
    if (view.polygon && detail)
      draw.AddCircleFilled(paper.at(curve.origin() + p.vertex), ui.px(2.4f), colour(c.mesh), 12);
    if (view.curve)
      draw.AddPolyline(points.data(), static_cast<int>(points.size()), colour(c.smooth_surface), 0, ui.px(2.4f));
    if (view.patches && detail)
      draw.AddCircle(paper.at(curve.origin() + p.last), ui.px(2.6f), colour(c.text_dim), 12, ui.px(1.0f));
  }
}

void draw_centres(const UiContext& ui, const PlanarCurve& curve, LocalCentre kind, std::uint32_t tracked,
                  const Paper& paper, ImDrawList& draw) {
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    const CurvePatch& p = curve.patch(i);
    if (p.straight || (curve.patch_count() > 200 && i != tracked)) continue;
    const ImVec2 centre = paper.at(curve.origin() + p.centre[static_cast<std::size_t>(kind)]);
    const bool ours = i == tracked;
    const ImU32 ink = colour(ui.palette.control_net, ours ? 0.9f : 0.35f);
    draw.AddCircleFilled(centre, ui.px(ours ? 3.5f : 2.0f), ink, 16);
    if (!ours) continue;
    for (const Vec2& end : {p.first, p.last}) draw.AddLine(centre, paper.at(curve.origin() + end), ink, ui.px(1.0f));
  }
}

void draw_tangents(const UiContext& ui, const TimeModel& time, const Paper& paper, const Rect& rect, ImDrawList& draw) {
  const auto trace = time.tick().iterations();
  const double reach = 0.22 * static_cast<double>(std::min(rect.w, rect.h));
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const IterationRecord& r = trace[i];
    const Rgba ink = iteration_colour(i, trace.size());
    const bool selected = time.tick().selected() == i;
    const ImVec2 middle = paper.at(r.point);
    const Vec2 along = reach * Vec2(r.normal.y, r.normal.x);  // in pixels, y down
    const ImVec2 half{static_cast<float>(along.x), static_cast<float>(along.y)};
    draw.AddLine({middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y}, colour(ink),
                 ui.px(selected ? 3.0f : 1.6f));
    draw.AddCircleFilled(middle, ui.px(selected ? 4.5f : 3.0f), colour(ink), 16);
    // To the finger's contact point on this line.
    draw.AddLine(middle, paper.at(r.contact), colour(ink, 0.6f), ui.px(1.0f));
    draw.AddCircle(paper.at(r.contact), ui.px(selected ? 5.5f : 4.0f), colour(ink), 16, ui.px(1.3f));
  }
}

void draw_finger(const UiContext& ui, const Finger& finger, const TickRecord& tick, const Paper& paper,
                 ImDrawList& draw) {
  const Palette& c = ui.palette;
  const ImVec2 centre = paper.at(tick.input.finger.position);
  const float radius = finger.shape == FingerShape::point ? 0.0f : paper.length(finger.radius_m);
  if (radius > 1.0f) {
    draw.AddCircleFilled(centre, radius, colour(c.finger, 0.16f), 96);
    draw.AddCircle(centre, radius, colour(c.finger, 0.9f), 96, ui.px(1.6f));
    // The fingerpad's middle: zero of the contact location.
    const Vec3 x = tick.input.finger.orientation * Vec3(1.0, 0.0, 0.0);
    const double turn = std::atan2(x.y, x.x);
    const ImVec2 pad{centre.x + radius * static_cast<float>(std::sin(turn)),
                     centre.y + radius * static_cast<float>(std::cos(turn))};
    draw.AddLine({centre.x + 0.9f * (pad.x - centre.x), centre.y + 0.9f * (pad.y - centre.y)}, pad, colour(c.finger),
                 ui.px(2.0f));
    // The contact on the finger, and the arc from the pad's middle.
    const Vec3& n = tick.output.normal;
    const float a0 = std::atan2(pad.y - centre.y, pad.x - centre.x);
    const float a1 = std::atan2(static_cast<float>(n.y), static_cast<float>(-n.x));
    const float way = std::remainder(a1 - a0, 6.2831853f);
    draw.PathArcTo(centre, radius, a0, a0 + way, 48);
    draw.PathStroke(colour(c.cld_commanded), 0, ui.px(3.2f));
    draw.AddCircleFilled({centre.x + radius * std::cos(a1), centre.y + radius * std::sin(a1)}, ui.px(4.5f),
                         colour(c.cld_commanded), 20);
  } else {
    draw.AddCircleFilled(centre, ui.px(4.0f), colour(c.finger), 20);
  }
}

void draw_force_arrow(const UiContext& ui, ImVec2 from, ImVec2 to, float width, ImU32 ink, ImDrawList& draw) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::max(1e-3f, std::sqrt(dx * dx + dy * dy)),
              head = std::min(ui.px(4.0f * width), length);
  const ImVec2 d{dx / length, dy / length}, neck{to.x - head * d.x, to.y - head * d.y};
  draw.AddLine(from, neck, ink, ui.px(width));
  draw.AddTriangleFilled(to, {neck.x - 0.42f * head * d.y, neck.y + 0.42f * head * d.x},
                         {neck.x + 0.42f * head * d.y, neck.y - 0.42f * head * d.x}, ink);
}

/// The arrows' numbers beyond the longer one's tip, on the finger's side, where no tangent or curve runs through them.
void draw_force_numbers(const UiContext& ui, const ForceArrows& arrows, ImVec2 from, ImVec2 tip, ImDrawList& draw) {
  struct Row {
    std::string text;
    Rgba ink;
  };
  std::vector<Row> rows;
  if (!arrows.same)
    rows.push_back({printed("%.2f N computed", arrows.computed_n), readable(ui.palette, ui.palette.force_computed)});
  rows.push_back({printed("%.2f N%s", arrows.felt_n, arrows.same ? "" : " felt"),
                  readable(ui.palette, ui.palette.force_magnitude)});
  ImFont* font = ui.fonts.small_number;
  const float line = ui.px(14), pad = ui.px(4), height = line * static_cast<float>(rows.size());
  float width = 0.0f;
  for (const Row& row : rows)
    width = std::max(width, font->CalcTextSizeA(font->FontSize, FLT_MAX, 0.0f, row.text.c_str()).x);
  const float dx = tip.x - from.x, dy = tip.y - from.y, length = std::max(1e-3f, std::sqrt(dx * dx + dy * dy)),
              off = std::max(length, ui.px(10)) + ui.px(8);
  const ImVec2 middle{from.x + dx / length * (off + 0.5f * width + pad),
                      from.y + dy / length * (off + 0.5f * height + pad)};
  const ImVec2 corner{middle.x - 0.5f * width, middle.y - 0.5f * height};
  draw.AddRectFilled({corner.x - pad, corner.y - 0.5f * pad}, {corner.x + width + pad, corner.y + height + 0.5f * pad},
                     colour(with_alpha(ui.palette.panel, 0.78f)), ui.px(3));
  float y = corner.y + 0.5f * (line - font->FontSize);
  for (const Row& row : rows) {
    draw.AddText(font, font->FontSize, {corner.x, y}, colour(row.ink), row.text.c_str());
    y += line;
  }
}

/// Computed and felt, each with its number; one arrow where they agree.
void draw_force(const UiContext& ui, const ServoRecord& record, const Paper& paper, ImDrawList& draw) {
  const TickOutput& out = record.tick.output;
  const Vec3& felt = record.device.force_command_n;
  const ForceArrows arrows = force_arrows(out.force_n, felt);
  if (!(std::max(arrows.computed_n, arrows.felt_n) > 1e-9)) return;
  const ImVec2 from = paper.at(out.contact), felt_tip = paper.at(out.contact + kForceScale * felt),
               computed_tip = paper.at(out.contact + kForceScale * out.force_n);
  const ImU32 felt_ink = colour(ui.palette.force_magnitude), computed_ink = colour(ui.palette.force_computed);
  if (arrows.felt_n > 1e-9) draw_force_arrow(ui, from, felt_tip, 2.6f, felt_ink, draw);
  if (!arrows.same && arrows.computed_n > 1e-9) draw_force_arrow(ui, from, computed_tip, 1.6f, computed_ink, draw);
  draw_force_numbers(ui, arrows, from, arrows.computed_n > arrows.felt_n ? computed_tip : felt_tip, draw);
}

/// A length that is 1, 2 or 5 times a power of ten and about a tenth of the view.
void draw_scale(const UiContext& ui, const PlanarView& view, const Rect& rect, ImDrawList& draw) {
  const double wanted = 0.12 * static_cast<double>(rect.w) / view.px_per_m,
               decade = std::pow(10.0, std::floor(std::log10(wanted)));
  const double length = decade * (wanted / decade >= 5.0 ? 5.0 : wanted / decade >= 2.0 ? 2.0 : 1.0);
  const float under =
      view.display ? static_cast<float>(kInsetBottom + static_cast<double>(kInsetHeight)) * ui.fonts.text->FontSize
                   : 0.0f;
  const float y = rect.bottom() - under - ui.px(16), x = rect.x + ui.px(16),
              w = static_cast<float>(length * view.px_per_m);
  const ImU32 ink = ui.colours.text_dim;
  const float text_y = y - ui.px(8) - ui.fonts.small_number->FontSize;
  if (text_y < rect.y + view.top) return;  // the toggles are there
  draw.AddLine({x, y}, {x + w, y}, ink, ui.px(1.6f));
  for (const float end : {x, x + w}) draw.AddLine({end, y - ui.px(4)}, {end, y + ui.px(4)}, ink, ui.px(1.6f));
  const std::string text = short_number(length * 1e3) + " mm";
  ImFont* font = ui.fonts.small_number;
  draw.AddText(font, font->FontSize, {x, text_y}, ink, text.c_str());
}

void draw_toggles(const UiContext& ui, PlanarView& view, const Rect& rect) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(6), ui.px(2)));
  float x = rect.x + ui.px(8), y = rect.y + ui.px(7);
  for (const PlanarToggle& toggle : kToggles) {
    const float w = ImGui::CalcTextSize(toggle.name).x + ui.px(12);
    if (x + w > rect.right() - ui.px(8)) {
      x = rect.x + ui.px(8);
      y += ImGui::GetFrameHeight() + ui.px(3);
    }
    ImGui::SetCursorScreenPos({x, y});
    toggle_button(ui, std::string("planar/") + toggle.name, toggle.name, view.*toggle.on, toggle.doc);
    x += w + ui.px(3);
  }
  view.top = y + ImGui::GetFrameHeight() - rect.y;
  ImGui::PopStyleVar();
  ImGui::PopFont();
}

}  // namespace

void draw_planar_view(const UiContext& ui, AppModel& model, PlanarView& view, const Rect& rect) {
  const PlanarCurve& curve = *model.scene().current()->planar();
  if (view.framed != model.scene().current().get() || view.framings != model.view().framings)
    frame_all(ui, model, view, rect);
  interact(model.devices(), view, rect);
  if (const TickRecord* tick = model.tick_in_view(); tick != nullptr && model.view().follow_contact)
    view.centre = Vec2(tick->output.contact.x, tick->output.contact.y);
  const Paper paper(view, rect);
  const LocalCentre kind = model.presets().current().solver.local_centre;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect({rect.x, rect.y}, {rect.right(), rect.bottom()}, true);
  const ServoRecord* record = model.time().tick().record();
  const Preset* then = record != nullptr ? model.time().preset(record->tick.preset_id) : nullptr;
  if (record != nullptr && view.finger)
    draw_finger(ui, (then != nullptr ? *then : model.presets().current()).finger, record->tick, paper, draw);
  if (record != nullptr) {
    const Vec3 reach((then != nullptr ? *then : model.presets().current()).finger.reach_m());
    const Vec3& at = record->tick.input.finger.position;
    ui.items.note("planar/finger", paper.at(at + Vec3(-reach.x, reach.y, 0.0)),
                  paper.at(at + Vec3(reach.x, -reach.y, 0.0)));
  }
  draw_curve(ui, view, curve, kind, paper, draw);
  if (view.centres)
    draw_centres(ui, curve, kind, record != nullptr ? record->tick.output.triangle : kNone, paper, draw);
  if (view.tangents) draw_tangents(ui, model.time(), paper, rect, draw);
  if (record != nullptr) {
    draw.AddCircleFilled(paper.at(record->tick.output.contact), ui.px(3.6f), colour(ui.palette.contact), 16);
    if (view.force) draw_force(ui, *record, paper, draw);
  }
  draw_scale(ui, view, rect, draw);
  const Box& box = model.scene().current()->mesh().bounds();
  const Vec3 origin = model.scene().current()->mesh().origin(), half = 0.5 * box.size();
  ui.items.note("planar/outline", paper.at(origin + Vec3(-half.x, half.y, 0.0)),
                paper.at(origin + Vec3(half.x, -half.y, 0.0)));
  if (record != nullptr && view.display) {
    const float em = ui.fonts.text->FontSize;
    const OverlayCanvas canvas{
        draw, {rect.x, rect.y}, {rect.w, rect.h}, ui.palette, ui.fonts.small, ui.fonts.small_number, em};
    const ImVec2 corner{rect.x + (static_cast<float>(kInsetLeft) + kInsetWidth) * em,
                        rect.bottom() - static_cast<float>(kInsetBottom) * em};
    ui.items.note("planar/inset", {rect.x, corner.y - kInsetHeight * em}, corner);
    draw_cld_inset(canvas, corner, model.presets().current().display.travel_m, &record->device.cld_command_m,
                   &record->device.cld_measured_m);
  }
  draw.PopClipRect();
  draw_toggles(ui, view, rect);
}

}  // namespace tangent
