#include "core/contact/follow/step_rule.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/walk.h"

#include <cmath>

namespace tangent {
namespace {

/// Solves xa da + xb db = r in the plane normal to n. False where xa and xb are parallel there.
bool solve_in_plane(const Vec3& xa, const Vec3& xb, const Vec3& n, const Vec3& r, double& da, double& db) {
  const Vec3 xb_turned = glm::cross(xb, n);  // xb x n: dot with a vector gives (vector x xb) . n
  const double det = glm::dot(xa, xb_turned);
  if (det == 0.0) return false;
  da = glm::dot(r, xb_turned) / det;
  db = glm::dot(glm::cross(xa, r), n) / det;
  return std::isfinite(da) && std::isfinite(db);
}

}  // namespace

double paper_gain(const SolverSettings& g, double curvature_per_m, double distance_m) {
  return g.gain_overall /
         ((1.0 + g.gain_curvature_m * curvature_per_m) * (1.0 + g.gain_distance_per_m * std::abs(distance_m)));
}

double paper_distance(const SolverSettings& settings, const PlaneContact& c) {
  return settings.distance_reading == DistanceReading::proxy ? c.penetration_m : c.height_m;
}

ParameterStep paper_face_step(const ContactMesh& mesh, const SolverSettings& settings, std::uint32_t triangle,
                              const SurfaceSample& s, const PlaneContact& c) {
  ParameterStep step;
  if (!to_barycentric(mesh, triangle, c.travel, step.da, step.db)) return step;
  const Vec3 ds = step.da * s.point_u + step.db * s.point_v;
  const Vec3 dn = step.da * s.normal_u + step.db * s.normal_v;
  const double ds2 = glm::dot(ds, ds);
  step.curvature_per_m = ds2 > 0.0 ? std::sqrt(glm::dot(dn, dn) / ds2) : 0.0;
  step.distance_m = paper_distance(settings, c);
  step.gain = paper_gain(settings, step.curvature_per_m, step.distance_m);
  step.da *= step.gain;
  step.db *= step.gain;
  step.valid = std::isfinite(step.da) && std::isfinite(step.db);
  return step;
}

ParameterStep damped_step(const SurfaceSample& s, const PlaneContact& c) {
  ParameterStep step;
  step.valid = solve_in_plane(s.point_u, s.point_v, s.normal, c.travel, step.da, step.db);
  if (!step.valid) return step;
  const Vec3 ds = step.da * s.point_u + step.db * s.point_v, dn = step.da * s.normal_u + step.db * s.normal_v;
  const double ds2 = glm::dot(ds, ds);
  step.curvature_per_m = ds2 > 0.0 ? std::sqrt(glm::dot(dn, dn) / ds2) : 0.0;
  step.distance_m = c.penetration_m;
  step.gain = 1.0 / (1.0 + std::abs(c.height_m) * step.curvature_per_m);
  step.da *= step.gain;
  step.db *= step.gain;
  return step;
}

}  // namespace tangent
