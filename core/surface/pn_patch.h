// One PN (point-normal) triangle: a cubic Bezier patch for the position and a quadratic Bernstein form
// for the normal, both from the three corner positions and corner normals alone.
//
// Sources: Vlachos, Peters, Boyd & Mitchell, "Curved PN Triangles", I3D 2001; derivatives and
// directional curvature: Doxon, Johnson, Tan & Provancher, Eqs. 2-8. As printed, the
// right column of their Eq. 3 has a slip: w' is -u' - v'.
//
// Barycentric weights: w for corner 0 (P1), u for corner 1 (P2), v for corner 2 (P3), u + v + w = 1.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tangent {

/// Weight of the mixed terms of the quadratic normal: 2 (a true Bernstein form, what Eq. 6 of Doxon et
/// al. differentiates) or 1 (as Vlachos et al. print it).
enum class NormalForm : std::uint8_t { bernstein, vlachos };

/// Control points b_ijk (i for w, j for u, k for v) in this order.
enum ControlPoint : std::uint8_t { b300, b030, b003, b210, b120, b021, b012, b102, b201, b111 };
inline constexpr std::array<const char*, 10> kControlPointNames{"b300", "b030", "b003", "b210", "b120",
                                                                "b021", "b012", "b102", "b201", "b111"};
/// Control normals n_ijk, unit length, in this order.
enum ControlNormal : std::uint8_t { n200, n020, n002, n110, n011, n101 };
inline constexpr std::array<const char*, 6> kControlNormalNames{"n200", "n020", "n002", "n110", "n011", "n101"};

/// Control points are held relative to corner 0, so that a small patch far from the origin keeps its digits.
struct PnPatch {
  Vec3 origin{0.0};              ///< corner 0, m
  std::array<Vec3, 10> offsets;  ///< control points - origin, indexed by ControlPoint, m
  std::array<Vec3, 6> normals;   ///< indexed by ControlNormal, unit
  double mixed_weight = 2.0;     ///< of n110, n011, n101

  Vec3 control_point(std::size_t b) const { return origin + offsets[b]; }
};

/// Point, unit normal and their first derivatives along u and v, with w = 1 - u - v.
/// `normal` is the interpolated normal, not the true normal of the surface.
struct SurfaceSample {
  Vec3 point, point_u, point_v;     ///< m, m, m
  Vec3 normal, normal_u, normal_v;  ///< unit, 1, 1 (of the unit normal)
};

/// Control point next to a corner with normal N, relative to the corner, for the edge Q - P that starts there:
/// ((Q-P) - ((Q-P).N) N) / 3, which is (2 P + Q - ((Q-P).N) N)/3 - P.
Vec3 edge_control_offset(const Vec3& edge, const Vec3& corner_normal);

/// The same where the corner has normals `n0`, `n1` on the two sides of the edge (a crease): a symmetric
/// blend, so that both sides get the same point bit for bit and the surface has no crack (compare
/// McDonald & Kilgard, "Crack-Free Point-Normal Triangles using Adjacent Edge Normals", 2010). The
/// component of the edge along the mean normal is removed whole; that along their difference by
/// sin^2 of the angle between them, so that equal normals give edge_control_offset and a right angle
/// gives the tangent of the crease.
Vec3 crease_control_offset(const Vec3& edge, const Vec3& n0, const Vec3& n1);

/// Patch of a triangle with smooth edges. Normals: unit.
PnPatch make_pn_patch(const std::array<Vec3, 3>& positions, const std::array<Vec3, 3>& normals,
                      NormalForm form = NormalForm::bernstein);

/// Replaces the two control points of edge k (0: v = 0, 1: w = 0, 2: u = 0), each given relative to its corner
/// (k and (k+1)%3); then call set_centre_point.
void set_edge_points(PnPatch& patch, int edge, const Vec3& from_first, const Vec3& from_second);
/// b111 = E + (E - V)/2 from the other nine.
void set_centre_point(PnPatch& patch);

/// Precondition: finite u, v. A normal that vanishes (only for corner normals over 90 deg apart) is
/// replaced by the normal of the flat triangle, with zero derivatives.
SurfaceSample evaluate(const PnPatch& patch, double u, double v);
/// The same in place, which spares the solver a copy. `sample` is no part of the patch.
void evaluate(const PnPatch& patch, double u, double v, SurfaceSample& sample);
Vec3 evaluate_point(const PnPatch& patch, double u, double v);
Vec3 evaluate_normal(const PnPatch& patch, double u, double v);

/// Whether the patch is the flat triangle itself with one normal all over, to within `room` of its longest side and of
/// a unit normal. Told of Bernstein normals only.
bool is_flat(const PnPatch& patch, double room);
/// What `evaluate` gives on such a patch, but for rounding, without its work.
inline void evaluate_flat(const PnPatch& patch, double u, double v, SurfaceSample& sample) {
  sample.point_u = patch.offsets[b030];
  sample.point_v = patch.offsets[b003];
  sample.point = patch.origin + (u * sample.point_u + v * sample.point_v);
  sample.normal = patch.normals[n200];
  sample.normal_u = sample.normal_v = Vec3(0.0);
}

/// Unit normal of the flat triangle; +z where it has no area.
Vec3 flat_normal(const PnPatch& patch);

/// A normal form is taken to vanish where it is shorter than this: its unit vector would be rounding. Larger: sharp
/// folds get flat normals; smaller: normals that point anywhere.
inline constexpr double kVanishingNormal = 1e-9;

struct SecondDerivatives {
  Vec3 point_uu, point_uv, point_vv;  ///< m
};
SecondDerivatives evaluate_second(const PnPatch& patch, double u, double v);

/// |dN|/|dS| along (du, dv), 1/m (Eq. 2). It has no sign and holds the geodesic torsion too.
/// Scale-free in (du, dv). 0 where dS vanishes.
double directional_curvature(const SurfaceSample& s, double du, double dv);

/// dN.dS/|dS|^2 along (du, dv), 1/m: the normal curvature of the interpolated normal field, positive where
/// the surface is convex (a sphere of radius r seen from outside: +1/r).
double normal_curvature(const SurfaceSample& s, double du, double dv);

/// Principal curvatures of the surface itself (true normal, second derivatives), 1/m, positive convex
/// with respect to the side `normal` points to; k1 >= k2. Directions are unit tangents. Zero where the
/// surface is singular.
struct PrincipalCurvatures {
  double k1 = 0.0, k2 = 0.0;
  Vec3 direction1{0.0}, direction2{0.0};
};
PrincipalCurvatures principal_curvatures(const SurfaceSample& s, const SecondDerivatives& d);

}  // namespace tangent
