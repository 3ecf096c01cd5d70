// What the raw mesh gives without smoothing: the facet and force-shading baselines.
#pragma once

#include "core/contact/nearest_triangles.h"
#include "core/contact/surface_place.h"

namespace tangent {

/// Contact of the finger's centre with the raw mesh.
struct FacetContact {
  bool found = false;
  Feature feature = Feature::none;  ///< of the flat triangle
  NearestHit hit;                   ///< local coordinates
  Vec3 normal{0.0};                 ///< +-unit(c - q), sign from the angle-weighted pseudonormal of the feature
  double height_m = 0.0;            ///< signed distance of the centre
};
/// `tolerance_m`: nearer than this the direction c - q means nothing and the pseudonormal is taken.
FacetContact facet_contact(const ContactMesh& mesh, const NearestTriangles& nearest, const Vec3& centre_local,
                           double tolerance_m);

/// Linearly interpolated corner normals at the facet contact (Morgenbesser & Srinivasan 1996): direction of
/// the force-shading baseline; place and depth stay the facet's.
Vec3 force_shading_normal(const ContactMesh& mesh, const FacetContact& contact);

/// Angle-weighted pseudonormal of the feature of triangle t that holds (u, v) (Baerentzen & Aanaes 2005), unit.
Vec3 pseudonormal(const ContactMesh& mesh, std::uint32_t t, double u, double v, Feature& feature);

}  // namespace tangent
