// The window on a display: GLFW, OpenGL 3.3 core, ImGui's back ends; drives an App frame by frame.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/app.h"

#include <functional>

namespace tangent {

/// Whether a window can be opened here; otherwise the reason ("X11: The DISPLAY environment ...").
Status display_available();

/// Opens the window and returns when it is closed. `should_stop` is polled once per frame (Ctrl-C); it may be empty.
/// Fails when there is no display, no OpenGL 3.3, or the shaders don't compile.
Status run_window(const AppOptions& options, const std::function<bool()>& should_stop = {});

}  // namespace tangent
