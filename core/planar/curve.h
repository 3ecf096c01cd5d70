// The smooth curve over a polygon: one quadratic Bezier a vertex, with its local centre (Doxon et al., appendix).
//
// The patch of vertex V between the segments L1 and L2 has the control polygon P1 = midpoint of L1, P2 = V,
// P3 = midpoint of L2. Its tangent line at t is that of de Casteljau (A1). A place on it has as its parameter the part
// of the angle from P1 to P3, seen from the local centre, that it has gone (A2). A vertex given twice, and an open end,
// have a segment of no length on one side: their patch is the straight half segment on the other.
//
// Coordinates are local: relative to the centre of the polygon's box.
#pragma once

#include "core/planar/patch_index.h"
#include "core/planar/polygon.h"
#include "core/preset/preset.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

/// What lies beyond an end of a patch.
enum class CurveJoint : std::uint8_t {
  smooth,  ///< the next patch, with the same tangent
  corner,  ///< the next patch, with another tangent: the vertex was given twice
  end,     ///< nothing
};

struct CurvePatch {
  Vec2 first, vertex, last;        ///< P1, P2, P3, m
  std::array<Vec2, 2> centre;      ///< by LocalCentre, m; both the midpoint where the bisectors' would leave a hole
  std::array<double, 2> turn_rad;  ///< by LocalCentre: angle from P1 to P3 about it, signed
  bool straight = false;           ///< P1, P2, P3 on one line: parameters are parts of the way
  CurveJoint joint_before = CurveJoint::smooth, joint_after = CurveJoint::smooth;
  PlanarBox box;                 ///< holds every place of the patch
  std::array<double, 2> room_m;  ///< by LocalCentre: places leave the triangle P1, P2, P3 by at most this
};

/// The tangent line of a patch at t, with derivatives by t, and the place on it that has t as its parameter.
struct LineSample {
  Vec2 foot, foot_t;            ///< point of the line between P1-P2 and P2-P3 (A1), m
  Vec2 direction, direction_t;  ///< unit, along the polygon
  Vec2 normal;                  ///< unit, towards the finger's side
  Vec2 place, place_t;          ///< where the contact is when it has converged to t, m
};

class PlanarCurve {
 public:
  /// Fails as check_polygon does.
  static Result<PlanarCurve> build(PlanarPolygon polygon);

  const PlanarPolygon& polygon() const { return polygon_; }  ///< as given, world
  const Vec2& origin() const { return origin_; }             ///< world = origin + local
  std::uint32_t patch_count() const { return static_cast<std::uint32_t>(patches_.size()); }
  const CurvePatch& patch(std::uint32_t i) const { return patches_[i]; }
  std::span<const CurvePatch> patches() const { return patches_; }
  bool closed() const { return polygon_.closed; }
  std::uint32_t after(std::uint32_t i) const { return i + 1 < patch_count() ? i + 1 : 0; }
  std::uint32_t before(std::uint32_t i) const { return i > 0 ? i - 1 : patch_count() - 1; }
  double side() const { return side_; }  ///< +1: the finger is to the left, -1: to the right
  Vec2 normal_of(const Vec2& direction) const { return side_ * Vec2(-direction.y, direction.x); }
  Vec2 vertex(std::uint32_t i) const { return patches_[i].vertex; }
  /// No place of the patch is nearer to `at` than this, m; below zero within its room.
  double distance_bound_m(std::uint32_t patch, LocalCentre centre, const Vec2& at) const;
  double size_m() const { return size_; }  ///< longest side of the box
  /// Patches by place. The box of item i also holds the segment from vertex i to the next.
  const PatchIndex& index() const { return index_; }
  std::size_t memory_bytes() const;  ///< what the arrays hold

  /// Any finite t; between 0 and 1 for the patch itself.
  LineSample sample(std::uint32_t patch, LocalCentre centre, double t) const;
  /// Parameter of a place (A2); below 0 before P1, above 1 beyond P3.
  double parameter(std::uint32_t patch, LocalCentre centre, const Vec2& place) const;
  /// Its derivative for a place that moves by `place_t`.
  double parameter_rate(std::uint32_t patch, LocalCentre centre, const Vec2& place, const Vec2& place_t) const;
  /// Point of the Bezier itself; the converged contacts lie within (angle of the patch)^3 of it.
  Vec2 bezier(std::uint32_t patch, double t) const;

 private:
  PlanarCurve() = default;
  PlanarPolygon polygon_;
  Vec2 origin_{0.0};
  double side_ = 1.0, size_ = 0.0;
  std::vector<CurvePatch> patches_;
  PatchIndex index_;
};

/// |dN| / |dplace| at t, 1/m: curvature of the rendered curve as the finger meets it.
double rendered_curvature(const LineSample& sample);

}  // namespace tangent
