// Overlay drawn on the 3D view with ImGui: labels, colour bar of the iterations, scales of length and force, axes, and
// the CLD inset. Takes the same plain data as the renderer. Sizes follow the fonts.
#pragma once

#include "workbench/gui/render/scene_renderer.h"

struct ImDrawList;
struct ImVec2;

namespace tangent {

struct ThemeFonts;

/// The cards in the lower left corner of the view: the CLD inset, and above it axes, scales and colour bar.
struct OverlayCards {
  bool inset = false, scales = false;  ///< shown: enabled, and there is room
  bool beside = false;                 ///< side by side, where the view is too low to stack them
  Vec2 size{0.0};                      ///< largest extent from the corner, points
};
/// `em`: height of the window's text, points. `room`: free height above the view's lower edge, points.
OverlayCards overlay_cards(const SceneToggles& toggles, float em, float room);

/// `top_left`: of the view, in ImGui's coordinates. `pixels_per_point`: the view's pixels per ImGui coordinate (1 when
/// it is shown pixel for pixel). `top`: height of the bar along its upper edge, points.
void draw_scene_overlay(ImDrawList& draw_list, const ImVec2& top_left, double pixels_per_point, float top,
                        const SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        const ThemeFonts& fonts);

}  // namespace tangent
