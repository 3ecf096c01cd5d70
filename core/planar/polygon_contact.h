// What the raw polygon gives without smoothing, in the terms of the raw mesh: the 2D baselines.
#pragma once

#include "core/baseline/two_pass.h"
#include "core/planar/curve.h"

namespace tangent {

/// The polygon's segments as facets. A hit's `triangle` is the segment's first vertex, `u` the part of the way along
/// it; z is 0.
class PolygonSurface final : public ProxySurface {
 public:
  /// `curve` must outlive it. `tolerance_m`: as for facet_contact.
  PolygonSurface(const PlanarCurve& curve, double tolerance_m) : curve_(curve), tolerance_m_(tolerance_m) {}

  /// Nearest point of the polygon, of equally near segments the lowest's; normal +-unit(centre - point), the sign from
  /// the feature's pseudonormal (the mean of the two segments' normals at a vertex), which is itself the normal when
  /// nearer than the tolerance.
  FacetContact nearest(const Vec3& centre) const override;
  /// Linear between the vertices' normals: means of the two segments', but for sharp corners and open ends.
  Vec3 interpolated_normal(const FacetContact& facet) const override;
  /// By distance, then segment.
  std::size_t near(const Vec3& centre, double reach_m, ProxyObstacles& closest) const override;

  /// Unit normal of the segment after vertex i.
  Vec2 segment_normal(std::uint32_t i) const;
  /// Of segment i at its first vertex or its second, unit.
  Vec2 vertex_normal(std::uint32_t i, bool second) const;

 private:
  bool has_segment(std::uint32_t i) const;
  Vec2 end_of(std::uint32_t i) const { return curve_.vertex(curve_.after(i)); }
  const PlanarCurve& curve_;
  double tolerance_m_;
};

}  // namespace tangent
