// What is written on top of the 3D picture with ImGui: labels, colour bar of the iterations, scales of
// length and force, axes, and the CLD inset. Same plain data as the renderer. Sizes follow the fonts.
#pragma once

#include "workbench/gui/render/scene_renderer.h"

struct ImDrawList;
struct ImVec2;

namespace tangent {

struct ThemeFonts;

/// The cards in the picture's lower left corner: the display's inset, and on it axes, scales and colour bar.
struct OverlayCards {
  bool inset = false, scales = false;  ///< which are there: those that are wanted and fit
  bool beside = false;                 ///< side by side: the picture is too low for one on the other
  Vec2 size{0.0};                      ///< width and height that they take at most, from the corner, points
};
/// `em`: height of the window's text, points. `room`: height over the picture's lower edge where nothing else is drawn,
/// points.
OverlayCards overlay_cards(const SceneToggles& toggles, float em, float room);

/// `top_left`: of the picture, in ImGui's coordinates. `pixels_per_point`: the picture's pixels per ImGui
/// coordinate (1 when it is shown pixel for pixel). `top`: what is drawn along its upper edge is this high, points.
void draw_scene_overlay(ImDrawList& draw_list, const ImVec2& top_left, double pixels_per_point, float top,
                        const SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        const ThemeFonts& fonts);

}  // namespace tangent
