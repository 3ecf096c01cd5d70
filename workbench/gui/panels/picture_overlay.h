// What the window writes over the 3D view (labels, scales, colour bar) drawn on a picture of another size, with fonts
// of that size.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/render/image.h"
#include "workbench/gui/render/scene_renderer.h"

namespace tangent {

/// The renderer's last picture, which `frame` was drawn in, with the overlay. Needs a current GL context. Inside or
/// outside a frame of ImGui: it has a context of its own. Fails where the driver refuses it.
Result<Image> with_overlay(AppModel& model, const SceneRenderer& renderer, const SceneFrame& frame,
                           const Camera& camera);

}  // namespace tangent
