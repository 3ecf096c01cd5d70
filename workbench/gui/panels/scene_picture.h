// The 3D view as a picture of any size, with nothing behind it where that is wanted: for a paper.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/render/scene_renderer.h"

namespace tangent {

/// Draws `frame`, as the view of `view_width` x `view_height` pixels shows it, at the width asked for; with what the
/// window writes over it where that is asked for. It is written by a thread of its own; a message says where it is, or
/// why not. Needs a current GL context.
void save_scene_picture(AppModel& model, SceneRenderer& renderer, SceneFrame frame, const ScenePicture& asked,
                        int view_width, int view_height);

}  // namespace tangent
