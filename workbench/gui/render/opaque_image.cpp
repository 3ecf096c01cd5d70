#include "workbench/gui/render/opaque_image.h"

#include <epoxy/gl.h>

#include <cstdint>

namespace tangent {

void add_opaque_image(ImDrawList& draw, unsigned texture, ImVec2 min, ImVec2 max) {
  const auto no_blending = [](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); };
  draw.AddCallback(no_blending, nullptr);
  draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)), min, max, {0, 1}, {1, 0});
  const auto blending = [](const ImDrawList*, const ImDrawCmd*) { glEnable(GL_BLEND); };
  draw.AddCallback(blending, nullptr);
}

}  // namespace tangent
