#include "devices/force_device.h"

#include <cmath>
#include <cstdio>

namespace tangent {

std::string pushed_axes(const ForceCapabilities& can) {
  std::string axes;
  for (std::size_t i = 0; i < can.pushes_along.size(); ++i)
    if (can.pushes_along[i]) axes += std::string(axes.empty() ? "" : ", ") + "xyz"[i];
  return axes.empty() ? "none" : axes;
}

std::string sensed_rotations(const ForceCapabilities& can) {
  constexpr std::array<const char*, 3> kNames{"roll", "tilt", "turn"};
  std::string names;
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (can.senses_rotation[i]) names += std::string(names.empty() ? "" : ", ") + kNames[i];
  return names.empty() ? "none" : names;
}

Quat as_sensed(const Quat& orientation, const std::array<bool, 3>& senses) noexcept {
  if (senses[0] && senses[1] && senses[2]) return orientation;
  const auto about = [](double angle, int axis) {
    Quat q(std::cos(0.5 * angle), 0.0, 0.0, 0.0);
    (axis == 0 ? q.x : axis == 1 ? q.y : q.z) = std::sin(0.5 * angle);
    return q;
  };
  // orientation = Rz(turn) Ry(tilt) Rx(roll); its x axis is (cos turn cos tilt, sin turn cos tilt, -sin tilt).
  const Vec3 x = orientation * Vec3(1.0, 0.0, 0.0);
  const Quat turn = about(std::atan2(x.y, x.x), 2), tilt = about(std::atan2(-x.z, std::hypot(x.x, x.y)), 1);
  const Quat roll = glm::conjugate(turn * tilt) * orientation;
  const Quat none(1.0, 0.0, 0.0, 0.0);
  return (senses[2] ? turn : none) * (senses[1] ? tilt : none) * (senses[0] ? roll : none);
}

std::string frame_text(const DeviceFrame& frame) {
  const Vec3 at = frame.origin_m * 1e3, turn = degrees_of(frame.rotation);
  char text[160];
  std::snprintf(text, sizeof text, "at %.1f %.1f %.1f mm, turned by %.1f %.1f %.1f deg", at.x, at.y, at.z, turn.x,
                turn.y, turn.z);
  return text;
}

}  // namespace tangent
