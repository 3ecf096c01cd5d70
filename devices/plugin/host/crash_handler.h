// The last attempt of a process that crashes in its plug-in: the plug-in's stop, from the signal handler.
#pragma once

#include "devices/plugin/plugin_library.h"

namespace tangent {

/// For the main thread. Signals that a sanitizer handles stay with it.
void stop_in_a_crash(PluginLibrary& library);
/// Nothing to stop any more.
void leave_crashes_alone() noexcept;

}  // namespace tangent
