// The contacts of a tick with a mesh: those that the preset's method and sources ask for.
#pragma once

#include "core/tick/scene.h"
#include "core/tick/sources.h"
#include "core/tick/step_cache.h"
#include "core/tick/tick_context.h"

namespace tangent {

/// Planes for force and display, and the row of the method, but for force and display. Precondition: a usable pose.
void find_mesh_contacts(const ContactScene& scene, StepCache& cache, const TickContext& tick, TickPlanes& planes,
                        TickOutput& out);

}  // namespace tangent
