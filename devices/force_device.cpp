#include "devices/force_device.h"

#include <cstdio>

namespace tangent {

std::string pushed_axes(const ForceCapabilities& can) {
  std::string axes;
  for (std::size_t i = 0; i < can.pushes_along.size(); ++i)
    if (can.pushes_along[i]) axes += std::string(axes.empty() ? "" : ", ") + "xyz"[i];
  return axes.empty() ? "none" : axes;
}

std::string frame_text(const DeviceFrame& frame) {
  const Vec3 at = frame.origin_m * 1e3, turn = degrees_of(frame.rotation);
  char text[160];
  std::snprintf(text, sizeof text, "at %.1f %.1f %.1f mm, turned by %.1f %.1f %.1f deg", at.x, at.y, at.z, turn.x,
                turn.y, turn.z);
  return text;
}

}  // namespace tangent
