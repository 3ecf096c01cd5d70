#include "workbench/gui/panels/scene_picture.h"

#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/render/image.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

Result<Image> draw_scene(SceneRenderer& renderer, SceneFrame& frame, const Camera& camera, int width, int height,
                         std::optional<Rgba> ground) {
  frame.ground = ground;
  if (!renderer.render(frame, camera, width, height))
    return fail("the graphics driver refuses a picture of this size",
                std::to_string(width) + " x " + std::to_string(height), "choose a smaller width");
  return read_texture(renderer.texture(), width, height);
}

}  // namespace

void save_scene_picture(AppModel& model, SceneRenderer& renderer, SceneFrame frame, const ScenePicture& wanted,
                        int view_width, int view_height) {
  constexpr int kMost = 8192;
  const double scale = std::min(wanted.width_px, kMost) / static_cast<double>(std::max(1, view_width));
  const int width = std::clamp(wanted.width_px, 16, kMost);
  const int height = std::clamp(static_cast<int>(std::lround(scale * view_height)), 16, kMost);
  frame.quality = RenderQuality::still;
  frame.pixel_scale *= scale;
  renderer.wait_for_tessellation();
  const auto picture = [&](std::optional<Rgba> ground) {
    return draw_scene(renderer, frame, model.view().camera, width, height, ground);
  };
  Result<Image> image = picture(wanted.transparent ? std::optional(rgb_hex(0x000000)) : std::nullopt);
  if (image && wanted.transparent) {
    const Result<Image> over_white = picture(rgb_hex(0xFFFFFF));
    image = over_white ? Result<Image>(with_alpha_of(*image, *over_white)) : over_white;
  }
  const Status written = image ? write_png(*image, wanted.path, {wanted.transparent, file_origin(model)})
                               : Status(tl::unexpected(image.error()));
  if (written)
    model.messages().say(Severity::note, "written to " + wanted.path.string());
  else
    model.messages().say(Severity::error, written.error().message());
}

}  // namespace tangent
