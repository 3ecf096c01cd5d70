// The window on a display: GLFW, OpenGL 3.3 core, ImGui's back ends; drives an App frame by frame.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/app.h"

#include <functional>

namespace tangent {

/// Whether a window could be opened here; the reason when not ("X11: The DISPLAY environment ...").
Status display_available();

/// Opens the window and returns when it is closed. `should_stop` is asked once a frame (Ctrl-C); it may be
/// empty. Fails when there is no display, no OpenGL 3.3, or the shaders can't be used.
Status run_window(const AppOptions& options, const std::function<bool()>& should_stop = {});

}  // namespace tangent
