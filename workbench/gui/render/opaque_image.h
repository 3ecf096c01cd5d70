// A picture in ImGui's draw list that hides what is under it: copied pixel by pixel instead of being blended, which is
// half the work of a software GL.
#pragma once

#include <imgui.h>

namespace tangent {

/// `texture`: a GL_TEXTURE_2D with its rows from below; drawn 1 : 1.
void add_opaque_image(ImDrawList& draw, unsigned texture, ImVec2 min, ImVec2 max);

}  // namespace tangent
