// Where in a view an object is to be looked at, so that nothing drawn over the picture lies on it.
#pragma once

#include "workbench/gui/render/camera.h"

#include <array>

namespace tangent {

/// The view is `size` points large. Something is drawn along the top and the right edge, as thick as that, and in a
/// card of this size in the lower left corner. In the order to prefer them in: about the view's middle; beside the
/// card; above it.
std::array<ViewRoom, 3> rooms_beside(const Vec2& size, double top, double right, const Vec2& card);

}  // namespace tangent
