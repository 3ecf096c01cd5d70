// The parts of a view that are not covered by cards and bars drawn over it.
#pragma once

#include "workbench/gui/render/camera.h"

#include <array>

namespace tangent {

/// `size`: of the view, points. `top`, `right`: thickness of the bars along these edges; `card`: size of the card in
/// the lower left corner. Returned in order of preference: around the view's middle; beside the card; above it.
std::array<ViewRoom, 3> rooms_beside(const Vec2& size, double top, double right, const Vec2& card);

}  // namespace tangent
