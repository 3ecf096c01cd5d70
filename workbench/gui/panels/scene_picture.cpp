#include "workbench/gui/panels/scene_picture.h"

#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/panels/picture_overlay.h"
#include "workbench/gui/render/image.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

Result<Image> draw_scene(AppModel& model, SceneRenderer& renderer, const SceneFrame& frame, const ScenePicture& wanted,
                         int height) {
  const int width = wanted.width_px;
  if (!renderer.render(frame, model.view().camera, width, height))
    return fail("the graphics driver refuses a picture of this size",
                std::to_string(width) + " x " + std::to_string(height), "choose a smaller width");
  if (wanted.overlay) return with_overlay(model, renderer, frame, model.view().camera);
  return read_texture(renderer.texture(), width, height);
}

}  // namespace

void save_scene_picture(AppModel& model, SceneRenderer& renderer, SceneFrame frame, const ScenePicture& asked,
                        int view_width, int view_height) {
  constexpr int kMost = 8192;
  ScenePicture wanted = asked;
  const double scale = std::min(wanted.width_px, kMost) / static_cast<double>(std::max(1, view_width));
  wanted.width_px = std::clamp(wanted.width_px, 16, kMost);
  const int height = std::clamp(static_cast<int>(std::lround(scale * view_height)), 16, kMost);
  frame.quality = RenderQuality::still;
  frame.pixel_scale *= scale;
  renderer.wait_for_tessellation();
  const auto picture = [&](std::optional<Rgba> ground) {
    frame.ground = ground;
    return draw_scene(model, renderer, frame, wanted, height);
  };
  Result<Image> image = picture(wanted.transparent ? std::optional(rgb_hex(0x000000)) : std::nullopt);
  Result<Image> over_white = wanted.transparent && image ? picture(rgb_hex(0xFFFFFF)) : Image();
  if (!image || !over_white)
    return model.messages().say(Severity::error, (image ? over_white : image).error().message());
  model.exports().start(wanted.path.filename().string(),
                        [image = std::move(*image), white = std::move(*over_white), wanted,
                         origin = file_origin(model)](const std::stop_token& stop) -> Result<std::string> {
                          const Image whole = wanted.transparent ? with_alpha_of(image, white) : image;
                          if (stop.stop_requested()) return fail("cancelled, nothing is written", wanted.path.string());
                          if (Status written = write_png(whole, wanted.path, {wanted.transparent, origin}); !written)
                            return tl::unexpected(written.error());
                          return "written to " + wanted.path.string();
                        });
}

}  // namespace tangent
