#include "workbench/gui/platform/scene_picture.h"

#include "workbench/gui/render/scene_overlay.h"
#include "workbench/gui/theme/theme.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace tangent {

void draw_scene_picture(OffscreenScreen& screen, SceneRenderer& renderer, const SceneFrame& frame, const Camera& camera,
                        const PictureSize& size) {
  ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
  std::vector<std::string> missing;
  const ThemeFonts fonts = load_fonts(static_cast<float>(size.scale), missing);
  screen.upload_fonts();
  screen.frame([&] {
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    renderer.render(frame, camera, size.width_px, size.height_px);
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(renderer.texture())), {0, 0},
                  {static_cast<float>(size.width_px), static_cast<float>(size.height_px)}, {0, 1}, {1, 0});
    draw_scene_overlay(list, {0, 0}, 1.0, 0.0f, renderer, frame, camera, fonts);
    ImGui::Render();
  });
}

}  // namespace tangent
