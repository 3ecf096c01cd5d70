#include "workbench/gui/render/camera.h"

#include "core/base/units.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tangent {
namespace {

constexpr double kMaxPitch = 89.0 * kDegree;
constexpr double kNearestZoom = 1e-6;  // of the scene radius
constexpr double kFurthestZoom = 50.0;

Vec3 turned_up(const Vec3& z_up, bool y_up) { return y_up ? Vec3(z_up.x, z_up.z, -z_up.y) : z_up; }

}  // namespace

Vec3 Camera::forward() const {
  const double c = std::cos(pitch_rad);
  return turned_up({-std::sin(yaw_rad) * c, std::cos(yaw_rad) * c, -std::sin(pitch_rad)}, y_up);
}

Vec3 Camera::right() const { return turned_up({std::cos(yaw_rad), std::sin(yaw_rad), 0.0}, y_up); }

Vec3 Camera::up() const { return glm::cross(right(), forward()); }

Vec3 Camera::eye() const { return target - distance_m * forward(); }

void Camera::look_from(const Vec3& direction) {
  if (!(glm::dot(direction, direction) > 0.0)) return;
  const Vec3 d = unit(direction);
  const Vec3 z_up = y_up ? Vec3(d.x, -d.z, d.y) : d;
  if (std::hypot(z_up.x, z_up.y) > 1e-9) yaw_rad = std::atan2(z_up.x, -z_up.y);
  pitch_rad = std::clamp(std::asin(std::clamp(z_up.z, -1.0, 1.0)), -kMaxPitch, kMaxPitch);
}

void Camera::turn_to_show(const Vec3& normal, double least_cosine) {
  if (!(glm::dot(normal, normal) > 0.0)) return;
  const Vec3 n = unit(normal), eye = -forward();
  const double cosine = glm::dot(n, eye);
  if (cosine >= least_cosine) return;
  Vec3 across = eye - cosine * n;  // of the eye's direction, square to the normal
  if (glm::dot(across, across) < 1e-12) across = std::abs(glm::dot(n, right())) < 0.9 ? right() : up();
  across = unit(across - glm::dot(across, n) * n);
  look_from(least_cosine * n + std::sqrt(1.0 - least_cosine * least_cosine) * across);
}

void Camera::orbit(double yaw_by_rad, double pitch_by_rad) {
  yaw_rad = std::remainder(yaw_rad + yaw_by_rad, 2.0 * std::numbers::pi);
  pitch_rad = std::clamp(pitch_rad + pitch_by_rad, -kMaxPitch, kMaxPitch);
}

void Camera::pan(double dx_px, double dy_px, int height_px) {
  const double metres = metres_per_pixel(target, height_px);
  target += metres * (dy_px * up() - dx_px * right());
}

void Camera::zoom(double factor) {
  if (!(factor > 0.0)) return;
  distance_m = std::clamp(distance_m * factor, kNearestZoom * scene_radius_m, kFurthestZoom * scene_radius_m);
}

void Camera::zoom_at(double factor, const Vec2& pixel, int width_px, int height_px) {
  const double before = metres_per_pixel(target, height_px);
  zoom(factor);
  const double moved = before - metres_per_pixel(target, height_px);
  const Vec2 from_middle =
      pixel - 0.5 * Vec2(width_px, height_px) - static_cast<double>(height_px) * Vec2(shift.x, -shift.y);
  target += moved * (from_middle.x * right() - from_middle.y * up());
}

void Camera::frame(const Box& world_box, double margin, const ViewRoom& room) {
  if (world_box.empty()) return;
  shift = room.shift;
  scene_centre = target = world_box.centre();
  scene_radius_m = std::max(0.5 * glm::length(world_box.size()), 1e-12);
  // A corner offset by (x, y), and nearer than the target by z, is in view from distance z + max(|x|, |y|) / tan on.
  const Vec3 half = 0.5 * world_box.size();
  const double widen = margin / std::tan(0.5 * fov_rad);
  double needed = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = half * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double across =
        std::max(std::abs(glm::dot(p, right())) / room.width, std::abs(glm::dot(p, up())) / room.height);
    needed = std::max(needed, widen * across - glm::dot(p, forward()));
  }
  distance_m = std::max(needed, 0.1 * scene_radius_m);
}

void Camera::frame(const Box& world_box, double margin, std::span<const ViewRoom> rooms) {
  Camera best = *this;
  best.frame(world_box, margin, rooms.front());
  for (const ViewRoom& room : rooms.subspan(1)) {
    Camera other = *this;
    other.frame(world_box, margin, room);
    if (other.distance_m < best.distance_m) best = other;
  }
  *this = best;
}

// A point offset by (x, y), and further than the target by z, is within slope a of the middle tx if
// |x - tx| <= a (z + d). For all points: max(x - a z) - a d <= tx <= min(x + a z) + a d. The smallest d at the field of
// view's slope is the distance; at that distance the smallest slope that contains all points gives the middle.
void Camera::fit(std::span<const Vec3> world_points, double margin, double aspect) {
  Box box;
  for (const Vec3& p : world_points) box.include(p);
  if (box.empty()) return;
  shift = Vec2(0.0);
  scene_centre = box.centre();
  scene_radius_m = std::max(0.5 * glm::length(box.size()), 1e-12);
  const Vec3 centre = scene_centre;
  const auto bounds = [&](const Vec3& axis, double slope) {
    double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
    for (const Vec3& p : world_points) {
      const double across = glm::dot(p - centre, axis), further = slope * glm::dot(p - centre, forward());
      from = std::max(from, across - further);
      to = std::min(to, across + further);
    }
    return std::pair(from, to);
  };
  const double opening = std::tan(0.5 * fov_rad) / margin;
  const std::array axes{std::pair(right(), opening * aspect), std::pair(up(), opening)};
  distance_m = 0.1 * scene_radius_m;
  for (const auto& [axis, slope] : axes) {
    const auto [from, to] = bounds(axis, slope);
    distance_m = std::max(distance_m, (from - to) / (2.0 * slope));
  }
  target = centre;
  for (const auto& [axis, slope] : axes) {
    double below = 0.0, enough = slope;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (below + enough);
      const auto [from, to] = bounds(axis, middle);
      (from - to <= 2.0 * middle * distance_m ? enough : below) = middle;
    }
    const auto [from, to] = bounds(axis, enough);
    target += 0.5 * (from + to) * axis;
  }
}

glm::dmat4 Camera::view_from(const Vec3& origin) const {
  const Vec3 at = target - origin;
  return glm::lookAt(at - distance_m * forward(), at, up());
}

// The depth range follows the distance, which keeps depth precision in close views of a contact; it always reaches
// behind the whole scene.
double Camera::near_m() const {
  const double to_scene = glm::length(eye() - scene_centre) - 2.0 * scene_radius_m;
  return std::max(to_scene, 0.02 * distance_m);
}

double Camera::far_m() const { return glm::length(eye() - scene_centre) + 3.0 * scene_radius_m + 2.0 * distance_m; }

glm::dmat4 Camera::projection(int width_px, int height_px) const {
  const double aspect = static_cast<double>(std::max(width_px, 1)) / std::max(height_px, 1);
  glm::dmat4 through = glm::perspective(fov_rad, aspect, near_m(), far_m());
  through[2][0] = -2.0 * shift.x / aspect;  // the column is divided by -z
  through[2][1] = -2.0 * shift.y;
  return through;
}

Vec3 Camera::project(const Vec3& world, int width_px, int height_px) const {
  // Relative to the target, for precision far from the world's origin.
  const glm::dvec4 clip = projection(width_px, height_px) * view_from(target) * glm::dvec4(world - target, 1.0);
  if (!(clip.w > 0.0)) return {0.0, 0.0, -1.0};
  const Vec3 ndc = Vec3(clip) / clip.w;
  return {(0.5 + 0.5 * ndc.x) * width_px, (0.5 - 0.5 * ndc.y) * height_px, 0.5 + 0.5 * ndc.z};
}

Ray Camera::ray_through(const Vec2& pixel, int width_px, int height_px) const {
  const double half = std::tan(0.5 * fov_rad);
  const double aspect = static_cast<double>(std::max(width_px, 1)) / std::max(height_px, 1);
  const double x = ((2.0 * pixel.x / std::max(width_px, 1) - 1.0) * aspect - 2.0 * shift.x) * half;
  const double y = (1.0 - 2.0 * pixel.y / std::max(height_px, 1) - 2.0 * shift.y) * half;
  return {eye(), unit(forward() + x * right() + y * up())};
}

double Camera::metres_per_pixel(const Vec3& world, int height_px) const {
  const double depth = std::max(glm::dot(world - eye(), forward()), 0.0);
  return 2.0 * depth * std::tan(0.5 * fov_rad) / std::max(height_px, 1);
}

}  // namespace tangent
