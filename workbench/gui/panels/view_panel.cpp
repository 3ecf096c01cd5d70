// The 3D view: the renderer's image, overlay and mouse input. Left or middle drag orbits, right drag (or Shift) pans,
// the wheel zooms about the pointer, a click picks a triangle. With "hand follows mouse" a left drag on the surface
// moves the simulated hand.
#include "workbench/gui/layout/view_room.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/scene_picture.h"
#include "workbench/gui/render/opaque_image.h"
#include "workbench/gui/render/scene_overlay.h"
#include "workbench/gui/widgets/thread_time.h"
#include "workbench/gui/widgets/widgets.h"

#include <array>
#include <cmath>

namespace tangent {

namespace {

struct LayerToggle {
  const char* name;
  bool SceneToggles::*on;
  const char* doc;
};
constexpr std::array kLayers{
    LayerToggle{"Facets", &SceneToggles::shaded, "The mesh as it is: flat triangles"},
    LayerToggle{"Edges", &SceneToggles::wireframe, "Edges of the triangles, or of the patches"},
    LayerToggle{"Surface", &SceneToggles::smooth_surface, "The smooth surface that is rendered: PN patches"},
    LayerToggle{"Net", &SceneToggles::control_net, "Control net of the tracked triangle: ten points"},
    LayerToggle{"Neighbours", &SceneToggles::control_net_neighbours, "Control nets across its three edges too"},
    LayerToggle{"Labels", &SceneToggles::control_point_labels, "Names of the control points"},
    LayerToggle{"Normals", &SceneToggles::vertex_normals, "Vertex normals"},
    LayerToggle{"Planes", &SceneToggles::planes, "Tangent planes of the tick's iterations, coloured by order"},
    LayerToggle{"Finger", &SceneToggles::finger, "The finger"},
    LayerToggle{"Force", &SceneToggles::force,
                "The computed force, and the felt one: what the safety gate lets through to the device"},
    LayerToggle{"Display", &SceneToggles::cld_inset, "The fingerpad from the side, with the roller where it is"}};

/// Returns the toggles' lower edge.
float draw_layer_toggles(const UiContext& ui, ViewModel& view, const Rect& rect) {
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.px(3), ui.px(3)));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(6), ui.px(2)));
  float x = rect.x + ui.px(8), y = rect.y + ui.px(7);
  for (const LayerToggle& layer : kLayers) {
    const float w = ImGui::CalcTextSize(layer.name).x + ui.px(12);
    if (x + w > rect.right() - ui.px(8)) {
      x = rect.x + ui.px(8);
      y += ImGui::GetFrameHeight() + ui.px(3);
    }
    ImGui::SetCursorScreenPos({x, y});
    toggle_button(ui, std::string("view/") + layer.name, layer.name, view.toggles.*layer.on, layer.doc);
    x += w + ui.px(3);
  }
  if (x + ImGui::CalcTextSize("Follow").x + ui.px(20) > rect.right() - ui.px(8)) {
    x = rect.x;
    y += ImGui::GetFrameHeight() + ui.px(3);
  }
  ImGui::SetCursorScreenPos({x + ui.px(8), y});
  toggle_button(ui, "view/follow", "Follow", view.follow_contact, "The camera goes with the contact (Shift+G)");
  const float below = y + ImGui::GetFrameHeight();
  ImGui::PopStyleVar(2);
  ImGui::PopFont();
  return below;
}

SceneFrame scene_frame(const AppModel& model) {
  SceneFrame frame;
  const ViewModel& view = model.view();
  frame.toggles = view.toggles;
  frame.theme = model.window().theme();
  frame.quality = view.quality;
  const Preset& preset = model.presets().current();
  frame.finger = preset.finger;
  frame.display_travel_m = preset.display.travel_m;
  frame.picked_triangle = view.picked_triangle;
  frame.hovered_triangle = view.hovered_triangle;
  frame.marked_triangles = model.view().inspection().marked;
  frame.net_of_picked = view.net_of_picked;
  const auto failures = model.tune().paint(model.map().colours);
  frame.map = failures ? failures : model.map().paint();
  frame.slice = view.slice;
  frame.isolation = view.isolation;
  if (const ServoRecord* record = model.time().tick().record()) {
    frame.tick = record->tick;
    frame.trace = model.time().tick().iterations();
    frame.beside_trace = model.time().beside().iterations();
    frame.selected_iteration = model.time().tick().selected();
    frame.felt_force_n = record->device.force_command_n;
    frame.cld_commanded_m = record->device.cld_command_m;
    frame.cld_measured_m = record->device.cld_measured_m;
    // The tick may have run under a preset other than the one being edited.
    const Preset* then = model.time().preset_of_tick();
    if (then != nullptr) frame.finger = then->finger;
  }
  return frame;
}

/// The finger's centre for a hand led to a place on the surface: on its normal, pressed in by the hand's depth.
Vec3 finger_centre(const AppModel& model, const Vec3& point, const Vec3& normal) {
  const double depth = model.devices().session() != nullptr ? model.devices().session()->hand().press_m : 0.0;
  return point + normal * (model.presets().current().finger.reach_m() - depth);
}

NearestTriangles::RayHit pick(const AppModel& model, const Vec2& pixel, int w, int h) {
  const ViewModel& view = model.view();
  return pick_triangle(*model.scene().current(), view.camera, pixel, w, h, view.slice, view.isolation.get());
}

void lead_hand(AppModel& model, ViewPanel& state, const Vec2& pixel, int w, int h) {
  const ContactMesh& mesh = model.scene().current()->mesh();
  const Ray ray = model.view().camera.ray_through(pixel, w, h);
  const auto hit = pick(model, pixel, w, h);
  if (hit) {
    const Vec3 point = ray.origin + ray.direction * hit.distance_m;
    Vec3 normal = (1.0 - hit.u - hit.v) * mesh.normal(hit.triangle, 0) + hit.u * mesh.normal(hit.triangle, 1) +
                  hit.v * mesh.normal(hit.triangle, 2);
    if (glm::dot(normal, normal) < 1e-12) return;
    normal = unit(normal);
    // Also when seen from inside, the finger stays on the side of the normals.
    state.drag_plane = finger_centre(model, point, normal);
  } else if (state.drag_plane) {
    // Off the mesh the hand continues in the plane that faces the eye, so that it can leave and return.
    const Vec3 facing = model.view().camera.forward();
    const double along = glm::dot(ray.direction, facing);
    if (along < 1e-6) return;
    state.drag_plane = ray.origin + ray.direction * (glm::dot(*state.drag_plane - ray.origin, facing) / along);
  } else {
    return;
  }
  model.devices().lead_hand(*state.drag_plane);
}

void orbit_pan_zoom(const UiContext& ui, Camera& camera, const Rect& rect, bool orbit_with_left) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool left = orbit_with_left && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  const bool middle = ImGui::IsMouseDown(ImGuiMouseButton_Middle), right = ImGui::IsMouseDown(ImGuiMouseButton_Right);
  const ImVec2 delta = io.MouseDelta;
  if (ImGui::IsItemActive() && (delta.x != 0.0f || delta.y != 0.0f)) {
    if (right || ((left || middle) && io.KeyShift)) {
      camera.pan(static_cast<double>(delta.x), static_cast<double>(delta.y), static_cast<int>(rect.h));
    } else if (left || middle) {
      const double per_pixel = 0.008 / static_cast<double>(ui.scale);
      camera.orbit(-static_cast<double>(delta.x) * per_pixel, static_cast<double>(delta.y) * per_pixel);
    }
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) {
    camera.zoom_at(std::pow(0.86, static_cast<double>(io.MouseWheel)),
                   Vec2(static_cast<double>(io.MousePos.x - rect.x), static_cast<double>(io.MousePos.y - rect.y)),
                   static_cast<int>(rect.w), static_cast<int>(rect.h));
  }
}

/// The plane whose contact point is under the pointer; the later of two that are equally near.
std::optional<std::size_t> plane_under(const UiContext& ui, const AppModel& model, const Vec2& pixel, int w, int h) {
  std::optional<std::size_t> found;
  if (!model.view().toggles.planes) return found;
  double nearest = static_cast<double>(ui.px(9));
  const auto iterations = model.time().tick().iterations();
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    if (iterations[i].feature == Feature::none) continue;
    const Vec3 p = model.view().camera.project(iterations[i].point, w, h);
    if (p.z < 0.0 || p.z > 1.0) continue;
    const double d = glm::length(Vec2(p) - pixel);
    if (d > nearest) continue;
    nearest = d;
    found = i;
  }
  return found;
}

void interact(const UiContext& ui, AppModel& model, ViewPanel& state, const Rect& rect) {
  const ImGuiIO& io = ImGui::GetIO();
  ViewModel& view = model.view();
  const int w = static_cast<int>(rect.w), h = static_cast<int>(rect.h);
  const Vec2 pixel(static_cast<double>(io.MousePos.x - rect.x), static_cast<double>(io.MousePos.y - rect.y));
  const bool leading = model.devices().hand_follows_mouse() && !io.KeyShift;
  orbit_pan_zoom(ui, view.camera, rect, !leading);
  view.hovered_triangle = kNone;
  if (model.scene().current() == nullptr) return;
  const bool dragged = io.MouseDragMaxDistanceSqr[0] > ui.px(4) * ui.px(4);
  if (leading && ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    lead_hand(model, state, pixel, w, h);
  } else if (ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !dragged && !leading) {
    // While paused, clicking a plane's point selects its row; any other click picks the triangle.
    if (const auto plane = model.time().paused() ? plane_under(ui, model, pixel, w, h) : std::nullopt) {
      model.time().tick().select(model.time().tick().selected() == plane ? std::nullopt : plane);
    } else {
      const auto hit = pick(model, pixel, w, h);
      view.picked_triangle = hit.triangle == view.picked_triangle ? kNone : hit.triangle;
    }
  }
  // Picks under the pointer only if the result is shown.
  const bool resting = ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown();
  if (!resting || !(model.map().on || view.picked_triangle != kNone)) return;
  if (const auto hit = pick(model, pixel, w, h)) {
    if (hit.triangle == view.picked_triangle) draw_triangle_card(ui, model, hit.triangle);
    if (!model.map().on) return;
    view.hovered_triangle = hit.triangle;
    if (hit.triangle != view.picked_triangle) draw_map_hover(ui, model.map(), hit.triangle, hit.u, hit.v);
  }
}

void draw_picture(const UiContext& ui, AppModel& model, ViewPanel& state, SceneRenderer& renderer, const Rect& rect) {
  const ImVec2 per_point = ImGui::GetIO().DisplayFramebufferScale;
  const double begin = thread_cpu_ms();
  renderer.set_scene(model.scene().current(), model.presets().current().solver.normal_form);
  SceneFrame frame = scene_frame(model);
  frame.pixel_scale = static_cast<double>(ui.scale * per_point.y);
  const int width_px = static_cast<int>(std::lround(rect.w * per_point.x)),
            height_px = static_cast<int>(std::lround(rect.h * per_point.y));
  if (const auto wanted = model.exports().take_scene_picture())
    save_scene_picture(model, renderer, frame, *wanted, width_px, height_px);
  renderer.render(frame, model.view().camera, width_px, height_px);
  state.build_ms_outside = thread_cpu_ms() - begin;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (renderer.texture() == 0) return;
  add_opaque_image(draw, renderer.texture(), {rect.x, rect.y}, {rect.right(), rect.bottom()});
  draw_scene_overlay(draw, {rect.x, rect.y}, static_cast<double>(per_point.x), state.top, renderer, frame,
                     model.view().camera, ui.fonts);
}

}  // namespace

void draw_view_panel(const UiContext& ui, AppModel& model, ViewPanel& state, SceneRenderer* renderer,
                     const Rect& rect) {
  state.build_ms_outside = 0.0;
  if (rect.w < 8.0f || rect.h < 8.0f) return;
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoBackground;
  ImGui::Begin("##view", nullptr, flags);
  ImGui::PopStyleVar();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const bool planar = model.scene().current() != nullptr && model.scene().current()->planar() != nullptr;
  if (planar || renderer == nullptr || renderer->texture() == 0) {  // the picture has its own ground
    const ImU32 top = packed(ui.palette.background_top), bottom = packed(ui.palette.background_bottom);
    draw.AddRectFilledMultiColor({rect.x, rect.y}, {rect.right(), rect.bottom()}, top, top, bottom, bottom);
  }

  // The toggles are submitted first, and the view's button lets them take the mouse.
  ImGui::SetCursorScreenPos({rect.x, rect.y});
  ImGui::InvisibleButton(
      "##scene", {rect.w, rect.h},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  ui.items.note_last("view");
  if (planar) {
    draw_planar_view(ui, model, state.planar, rect);
  } else {
    model.view().size = {rect.w, rect.h};
    interact(ui, model, state, rect);
    if (renderer != nullptr) draw_picture(ui, model, state, *renderer, rect);
    const float below_toggles = draw_layer_toggles(ui, model.view(), rect);
    const float map_bar = draw_map_bar(ui, model, rect, below_toggles + ui.px(8));
    state.top = below_toggles - rect.y + ui.px(4);
    const OverlayCards cards = overlay_cards(model.view().toggles, ui.fonts.text->FontSize, rect.h - state.top);
    model.view().rooms = rooms_beside({rect.w, rect.h}, state.top, map_bar + ui.px(8), cards.size);
  }
  if (model.scene().loading()) {
    const std::string text = "Loading " + model.scene().loading_name();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw.AddText({rect.x + 0.5f * (rect.w - size.x), rect.y + 0.5f * rect.h}, ui.colours.text, text.c_str());
  }
  if (model.devices().hand_follows_mouse()) {
    const char* text = "Hand follows mouse: drag on the surface";
    const ImVec2 size = ImGui::CalcTextSize(text);
    draw.AddText({rect.x + 0.5f * (rect.w - size.x), rect.bottom() - size.y - ui.px(8)}, ui.colours.accent, text);
  }
  ImGui::End();
}

}  // namespace tangent
