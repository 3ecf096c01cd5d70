// What is written on top of the 3D picture with ImGui: labels, colour bar of the iterations, scales of
// length and force, axes, and the CLD inset. Same plain data as the renderer. Sizes follow the fonts.
#pragma once

#include "workbench/gui/render/scene_renderer.h"

struct ImDrawList;
struct ImVec2;

namespace tangent {

struct ThemeFonts;

/// Width and height, from the picture's lower left corner, of the cards that stand there: the most they take. `em`: height
/// of the window's text.
Vec2 overlay_cards(const SceneToggles& toggles, float em);

/// `top_left`: of the picture, in ImGui's coordinates. `pixels_per_point`: the picture's pixels per ImGui
/// coordinate (1 when it is shown pixel for pixel).
void draw_scene_overlay(ImDrawList& draw_list, const ImVec2& top_left, double pixels_per_point,
                        const SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        const ThemeFonts& fonts);

}  // namespace tangent
