// Orbit camera. World frame, metres, double precision. Pixels count from the top left corner of the view: ImGui's mouse
// position minus the view's corner.
#pragma once

#include "core/base/vec.h"

#include <glm/mat4x4.hpp>

#include <span>

namespace tangent {

struct Ray {
  Vec3 origin{0.0};                ///< world, m
  Vec3 direction{0.0, 0.0, -1.0};  ///< unit
};

/// The part of a view in which to show an object, in units of the view's height.
struct ViewRoom {
  double width = 1.3, height = 1.0;
  Vec2 shift{0.0};  ///< its middle relative to the view's; right and up positive
};

struct Camera {
  Vec3 target{0.0};             ///< centre of view and orbit, world, m
  double distance_m = 0.3;      ///< eye to target
  double yaw_rad = -0.6;        ///< about the up axis; 0: eye on the -y side of the target (+z with y_up)
  double pitch_rad = 0.45;      ///< eye above the horizon; within +-89 deg
  double fov_rad = 0.6;         ///< vertical field of view
  double scene_radius_m = 0.1;  ///< set by frame(); determines zoom limits and depth range
  Vec3 scene_centre{0.0};       ///< from frame()
  bool y_up = false;            ///< +y is up on screen (many scanned meshes); else +z
  Vec2 shift{0.0};  ///< image position of the target relative to the view's middle, in view heights (lens shift)

  bool operator==(const Camera&) const = default;

  Vec3 eye() const;
  Vec3 forward() const;  ///< unit, eye to target
  Vec3 right() const;
  Vec3 up() const;

  /// Orbits so that the eye is in this direction from the target (pitch limited); zero: no effect.
  void look_from(const Vec3& direction);
  /// Turns about the target, by as little as it takes, until a surface there with this normal is seen at least at this
  /// cosine between its normal and the direction to the eye.
  void turn_to_show(const Vec3& normal, double least_cosine);
  void orbit(double yaw_by_rad, double pitch_by_rad);
  /// Moves the target so that points at its depth follow the pointer. dy > 0: pointer moved down.
  void pan(double dx_px, double dy_px, int height_px);
  /// Multiplies the distance (0.9: nearer), within 1e-6 .. 50 scene radii.
  void zoom(double factor);
  /// Zooms and keeps the point under the pixel, at the target's depth, in place.
  void zoom_at(double factor, const Vec2& pixel, int width_px, int height_px);
  /// Frames the whole box without turning: its corners fit into `room`, with `margin` to spare (1: a tight fit). No
  /// effect for an empty box.
  void frame(const Box& world_box, double margin = 1.1, const ViewRoom& room = {});
  /// The same, in the room that shows it largest; the first of equals. Precondition: rooms is not empty.
  void frame(const Box& world_box, double margin, std::span<const ViewRoom> rooms);
  /// Frames these points as large as possible, centred in the image; the orbit's centre is then not their centre. No
  /// effect without points.
  void fit(std::span<const Vec3> world_points, double margin, double aspect);

  /// World relative to `origin` -> eye space (the eye looks along -z). Subtracting the origin in double, before
  /// conversion to float, keeps pixels steady a kilometre away from it.
  glm::dmat4 view_from(const Vec3& origin) const;
  glm::dmat4 projection(int width_px, int height_px) const;
  double near_m() const;
  double far_m() const;

  /// Pixel of a world point; z is depth in 0..1, outside that range when behind the eye or clipped.
  Vec3 project(const Vec3& world, int width_px, int height_px) const;
  Ray ray_through(const Vec2& pixel, int width_px, int height_px) const;
  /// Metres covered by one pixel at the depth of a world point.
  double metres_per_pixel(const Vec3& world, int height_px) const;
};

}  // namespace tangent
