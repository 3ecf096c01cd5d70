#include "core/lab/gains/paper_contraction.h"

#include "core/contact/follow/step_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tangent {
namespace {

constexpr int kDirections = 4;    // over half a turn, since the map is odd
constexpr int kSettling = 24;     // steps until the direction has settled or cycles
constexpr int kMeasured = 16;     // steps over which the shrinkage is averaged; even, since two gains may alternate
constexpr double kLanded = 1e-9;  // shrinkage below which nothing is left

/// Ratio of the error after one plane to that before it, and the direction of the remaining travel.
struct Shrinkage {
  double factor;
  Vec3 direction;
};

Shrinkage one_plane(const ContactMesh& mesh, std::uint32_t triangle, const SurfaceSample& place, const Preset& preset,
                    const ContactJacobian& jacobian, PlaneContact contact, const Vec3& direction) {
  contact.travel = direction;
  contact.error_m = 1.0;
  const ParameterStep step = paper_face_step(mesh, preset.solver, triangle, place, contact);
  if (!step.valid) return {std::numeric_limits<double>::infinity(), direction};
  Vec3 left = direction - step.da * jacobian.xa - step.db * jacobian.xb;
  left -= glm::dot(left, place.normal) * place.normal;
  const double factor = std::sqrt(glm::dot(left, left));
  return {factor, factor > 0.0 ? left / factor : direction};
}

}  // namespace

FingerPose pose_touching(const Finger& finger, const SurfaceSample& s, double penetration_m) {
  FingerPose pose;
  pose.position = s.point - penetration_m * s.normal - support_point(finger, pose, s.normal);
  return pose;
}

double paper_contraction(const ContactMesh& mesh, std::uint32_t triangle, const SurfaceSample& s, const Preset& preset,
                         double penetration_m) {
  const FingerPose pose = pose_touching(preset.finger, s, penetration_m);
  const PlaneContact contact = contact_on_plane(preset.finger, pose, s.point, s.normal);
  const ContactJacobian jacobian = contact_jacobian(preset.finger, pose, s, contact);
  Vec3 across = s.point_u - glm::dot(s.point_u, s.normal) * s.normal;
  const double length = std::sqrt(glm::dot(across, across));
  if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
  across /= length;
  const Vec3 along = glm::cross(s.normal, across);
  double worst = 0.0;
  for (int d = 0; d < kDirections; ++d) {
    // Off the axes: a principal direction is a fixed point of the map, often an unstable one.
    const double angle = std::numbers::pi * (d + 0.31) / kDirections;
    Vec3 direction = std::cos(angle) * across + std::sin(angle) * along;
    double log_sum = 0.0;
    bool landed = false;
    for (int i = 0; i < kSettling + kMeasured && !landed; ++i) {
      const Shrinkage next = one_plane(mesh, triangle, s, preset, jacobian, contact, direction);
      if (!std::isfinite(next.factor)) return std::numeric_limits<double>::infinity();
      landed = next.factor < kLanded;
      direction = next.direction;
      if (i >= kSettling) log_sum += std::log(std::max(next.factor, kLanded));
    }
    if (!landed) worst = std::max(worst, std::exp(log_sum / kMeasured));
  }
  return worst;
}

}  // namespace tangent
