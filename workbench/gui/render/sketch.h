// Everything in the 3D view except the mesh: strokes, points, translucent fills, lit solids and labels, collected on
// the CPU each frame. Positions are relative to an origin (the camera's target) and in units of a scale, so that float
// precision suffices near the target.
#pragma once

#include "core/base/vec.h"
#include "workbench/gui/theme/palette.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace tangent {

/// One instance of strokes.vert.glsl; a == b makes a round point of diameter width_px.
struct Stroke {
  std::array<float, 3> a, b;
  std::uint32_t colour;
  float width_px;
  bool operator==(const Stroke&) const = default;
};

struct FillVertex {
  std::array<float, 3> position;
  std::uint32_t colour;
  bool operator==(const FillVertex&) const = default;
};

enum class SolidShape : std::uint8_t { ball, cylinder, cone };

/// A solid along its x axis: semi_axes * unit shape, with its halves moved apart by half_length each.
struct Solid {
  SolidShape shape = SolidShape::ball;
  glm::mat4 place{1.0f};  ///< body frame -> sketch frame, rigid
  glm::vec3 semi_axes{1.0f};
  float half_length = 0.0f;
  Rgba colour;  ///< alpha: opacity where the surface faces the eye
  float rim_opacity = 1.0f;
  bool operator==(const Solid&) const = default;
};

class Sketch {
 public:
  bool operator==(const Sketch&) const = default;
  void begin(const Vec3& origin_world, double scale_m);

  void line(const Vec3& a, const Vec3& b, Rgba colour, double width_px);
  /// A filled dot with a thin dark rim, visible on any background.
  void point(const Vec3& p, Rgba colour, double diameter_px);
  void ring(const Vec3& centre, const Vec3& normal, double radius_m, Rgba colour, double width_px);
  void disc(const Vec3& centre, const Vec3& normal, double radius_m, Rgba colour);
  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, Rgba colour);
  void ellipsoid(const Vec3& centre, const Quat& orientation, const Vec3& semi_axes_m, double half_length_m,
                 Rgba colour, double rim_opacity);
  /// Lit arrow; nothing when it is shorter than a billionth of the scale.
  void arrow(const Vec3& from, const Vec3& to, double shaft_radius_m, Rgba colour);

  const std::vector<Stroke>& strokes() const { return strokes_; }
  const std::vector<FillVertex>& fills() const { return fills_; }
  const std::vector<Solid>& solids() const { return solids_; }
  const Vec3& origin() const { return origin_; }
  double scale_m() const { return scale_m_; }

 private:
  std::array<float, 3> local(const Vec3& world) const;

  Vec3 origin_{0.0};
  double scale_m_ = 1.0;
  std::vector<Stroke> strokes_;
  std::vector<FillVertex> fills_;
  std::vector<Solid> solids_;
};

}  // namespace tangent
