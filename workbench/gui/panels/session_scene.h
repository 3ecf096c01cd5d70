// The 3D view of a session: camera, layers, map, slice, and what is picked, marked and isolated.
#pragma once

#include "workbench/gui/panels/session_values.h"

namespace tangent {

class AppModel;

void put_scene_view(const AppModel& model, ViewValues& out);
/// Of the mesh in view.
void show_scene_view(AppModel& model, const SavedValues& values);
/// The camera alone. What is in view has moved it, perhaps.
void show_camera(AppModel& model, const ViewValues& values);

}  // namespace tangent
