// The two-pass proxy of Ruspini, Kolarov & Khatib 1997, a baseline: the ordinary proxy is found first; then the point
// nearest to the finger on the plane through it with the interpolated normal becomes the goal of a second update.
#pragma once

#include "core/baseline/facet.h"
#include "core/baseline/proxy.h"

namespace tangent {

/// A point finger gets a proxy of this radius, m: rolling over an edge takes a ball. Larger: edges of a point finger
/// feel rounder; smaller: more rounds at an edge.
inline constexpr double kLeastProxyRadius = 1e-4;

struct TwoPassContact {
  bool found = false;
  FacetContact facet;          ///< of the proxy with the raw mesh: place and, for the display, normal
  Vec3 proxy{0.0};             ///< centre of the ball, local, m; to be kept for the next tick
  Vec3 normal{0.0, 0.0, 1.0};  ///< of the force: from finger to proxy, unit
  double penetration_m = 0.0;  ///< length of that; negative: how far the finger is from touching
};

/// What a surface must offer for a two-pass proxy; meshes and polygons do.
struct ProxySurface {
  virtual ~ProxySurface() = default;
  virtual FacetContact nearest(const Vec3& centre) const = 0;             ///< not found: there is no surface
  virtual Vec3 interpolated_normal(const FacetContact& facet) const = 0;  ///< unit
  virtual std::size_t near(const Vec3& centre, double reach_m, ProxyObstacles& closest) const = 0;
};

/// `centre`: of a ball finger of `radius_m` (0: a point). `kept`: the last tick's proxy, null: none. A proxy further
/// from the finger than `leap_m` is given up and starts anew at the nearest place.
TwoPassContact two_pass_contact(const ProxySurface& surface, const Vec3& centre, double radius_m, double tolerance_m,
                                const Vec3* kept, double leap_m);

/// The raw mesh as obstacles.
class MeshProxySurface final : public ProxySurface {
 public:
  /// Both must outlive it.
  MeshProxySurface(const ContactMesh& mesh, const NearestTriangles& nearest, double tolerance_m)
      : mesh_(mesh), nearest_(nearest), tolerance_m_(tolerance_m) {}
  FacetContact nearest(const Vec3& centre) const override {
    return facet_contact(mesh_, nearest_, centre, tolerance_m_);
  }
  Vec3 interpolated_normal(const FacetContact& facet) const override { return force_shading_normal(mesh_, facet); }
  std::size_t near(const Vec3& centre, double reach_m, ProxyObstacles& closest) const override;

 private:
  const ContactMesh& mesh_;
  const NearestTriangles& nearest_;
  double tolerance_m_;
};

}  // namespace tangent
