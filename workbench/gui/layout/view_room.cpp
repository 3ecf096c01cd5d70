#include "workbench/gui/layout/view_room.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr double kSmallest = 0.05;  // heights of the view: minimum size of a room in small windows

ViewRoom room_between(const Vec2& size, double left, double right, double top, double bottom) {
  const double unit = std::max(size.y, 1.0);
  return {.width = std::max((right - left) / unit, kSmallest),
          .height = std::max((bottom - top) / unit, kSmallest),
          .shift = Vec2(0.5 * (left + right - size.x), 0.5 * (size.y - top - bottom)) / unit};
}

}  // namespace

std::array<ViewRoom, 3> rooms_beside(const Vec2& size, double top, double right, const Vec2& card) {
  const double edge = std::max(card.x, right);
  return {room_between(size, edge, size.x - edge, top, size.y), room_between(size, card.x, size.x - right, top, size.y),
          room_between(size, 0.0, size.x - right, top, size.y - card.y)};
}

}  // namespace tangent
