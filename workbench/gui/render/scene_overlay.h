// What is written on top of the 3D picture with ImGui: labels, colour bar of the iterations, CLD inset,
// force scale, axes and scale bar. Same plain data as the renderer.
#pragma once

#include "workbench/gui/render/scene_renderer.h"

struct ImDrawList;
struct ImVec2;

namespace tangent {

/// `top_left`: of the image, in ImGui points. `pixels_per_point`: the picture's pixels per ImGui point
/// (1 when width_px equals the image's width on screen). Fonts: the current one, and `numbers` for values
/// (a monospaced ImFont*, may be null).
void draw_scene_overlay(ImDrawList& draw_list, const ImVec2& top_left, double pixels_per_point,
                        const SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        void* numbers = nullptr);

}  // namespace tangent
