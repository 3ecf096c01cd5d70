#include "workbench/gui/render/camera_text.h"

#include "core/base/units.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

namespace tangent {

std::string camera_text(const Camera& c) {
  char text[320];
  std::snprintf(text, sizeof text,
                "camera target_m %.17g %.17g %.17g distance_m %.17g yaw_deg %.17g pitch_deg %.17g up %s", c.target.x,
                c.target.y, c.target.z, c.distance_m, c.yaw_rad / kDegree, c.pitch_rad / kDegree, c.y_up ? "y" : "z");
  return text;
}

std::optional<Camera> parse_camera(std::string_view text, Camera now) {
  std::istringstream in{std::string(text)};
  std::string word, target, distance, yaw, pitch, up, axis;
  double yaw_deg = 0.0, pitch_deg = 0.0;
  in >> word >> target >> now.target.x >> now.target.y >> now.target.z >> distance >> now.distance_m >> yaw >>
      yaw_deg >> pitch >> pitch_deg >> up >> axis;
  const bool sound = in && word == "camera" && target == "target_m" && distance == "distance_m" && yaw == "yaw_deg" &&
                     pitch == "pitch_deg" && up == "up" && (axis == "y" || axis == "z");
  if (!sound || !is_finite(now.target) || !(now.distance_m > 0.0) || !(std::abs(pitch_deg) < 90.0)) return std::nullopt;
  now.yaw_rad = std::remainder(yaw_deg * kDegree, 2.0 * std::numbers::pi);
  now.pitch_rad = pitch_deg * kDegree;
  now.y_up = axis == "y";
  return now;
}

Camera standard_view(StandardView view, Camera camera) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  camera.pitch_rad = 0.0;
  switch (view) {
    case StandardView::front:
      camera.yaw_rad = 0.0;
      break;
    case StandardView::back:
      camera.yaw_rad = 2.0 * kQuarter;
      break;
    case StandardView::left:
      camera.yaw_rad = -kQuarter;
      break;
    case StandardView::right:
      camera.yaw_rad = kQuarter;
      break;
    case StandardView::top:
      camera.yaw_rad = 0.0, camera.orbit(0.0, kQuarter);
      break;
    case StandardView::bottom:
      camera.yaw_rad = 0.0, camera.orbit(0.0, -kQuarter);
      break;
    case StandardView::corner:
      camera.yaw_rad = -0.6, camera.pitch_rad = 0.45;
      break;
  }
  return camera;
}

}  // namespace tangent
