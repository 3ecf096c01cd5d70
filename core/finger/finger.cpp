#include "core/finger/finger.h"

#include "core/base/arc_tangent.h"
#include "core/finger/plane_contact.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Most devices measure no turn.
bool unturned(const Quat& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0; }

Vec3 to_finger_frame(const FingerPose& pose, const Vec3& v) {
  return unturned(pose.orientation) ? v : glm::conjugate(pose.orientation) * v;
}

Support ellipsoid_support(const Finger& finger, const FingerPose& pose, const Vec3& normal) {
  // Furthest point along -n of the ellipsoid x = A y, |y| = 1 is -A A n / |A n|.
  const Vec3 n = to_finger_frame(pose, normal);
  const Vec3 a2 = finger.semi_axes_m * finger.semi_axes_m;
  const Vec3 a2n = a2 * n;
  const double length = std::sqrt(glm::dot(n, a2n));
  const Mat3 rotation = glm::mat3_cast(pose.orientation);
  const Mat3 axes(Vec3(a2.x, 0, 0), Vec3(0, a2.y, 0), Vec3(0, 0, a2.z));
  const Mat3 local = (glm::outerProduct(a2n, a2n) / (length * length) - axes) / length;
  return {pose.position - pose.orientation * (a2n / length), rotation * local * glm::transpose(rotation)};
}

Vec3 ellipsoid_support_point(const Finger& finger, const FingerPose& pose, const Vec3& normal) {
  const Vec3 n = to_finger_frame(pose, normal);
  const Vec3 a2n = finger.semi_axes_m * finger.semi_axes_m * n;
  return pose.position - pose.orientation * (a2n / std::sqrt(glm::dot(n, a2n)));
}

Support capsule_support(const Finger& finger, const FingerPose& pose, const Vec3& normal) {
  const Vec3 axis = pose.orientation * Vec3(1.0, 0.0, 0.0);
  const double along = glm::dot(axis, normal);
  // Sphere of radius R plus the spindle with support function L sqrt(along^2 + s^2 |n|^2).
  const double L = finger.half_length_m, s2 = kSpindle * kSpindle;
  const double root = std::sqrt(along * along + s2);
  const Vec3 gradient = along * axis + s2 * normal;
  Support support;
  support.point = pose.position - finger.radius_m * normal - (L / root) * gradient;
  const Mat3 hessian = (glm::outerProduct(axis, axis) + s2 * Mat3(1.0)) / root -
                       glm::outerProduct(gradient, gradient) / (root * root * root);
  support.by_normal = -finger.radius_m * Mat3(1.0) - L * hessian;
  return support;
}

Vec3 capsule_support_point(const Finger& finger, const FingerPose& pose, const Vec3& normal) {
  const Vec3 axis = pose.orientation * Vec3(1.0, 0.0, 0.0);
  const double along = glm::dot(axis, normal), s2 = kSpindle * kSpindle;
  const Vec3 gradient = along * axis + s2 * normal;
  return pose.position - finger.radius_m * normal - (finger.half_length_m / std::sqrt(along * along + s2)) * gradient;
}

/// Arc of the ellipse (a sin t, -c cos t) from t = 0, by Legendre's incomplete integral of the second kind.
double ellipse_arc(double a, double c, double t) {
  if (a <= 0.0 || c <= 0.0) return std::max(a, c) * std::sin(t);
  if (a == c) return a * t;
  if (a > c) return a * std::ellint_2(std::sqrt(1.0 - (c / a) * (c / a)), t);
  const double k = std::sqrt(1.0 - (a / c) * (a / c));
  const double quarter = std::comp_ellint_2(k);
  return c * (quarter - std::ellint_2(k, 0.5 * std::acos(-1.0) - t));
}

}  // namespace

double Finger::reach_m() const {
  switch (shape) {
    case FingerShape::point:
      return 0.0;
    case FingerShape::sphere:
      return radius_m;
    case FingerShape::ellipsoid:
      return std::max({semi_axes_m.x, semi_axes_m.y, semi_axes_m.z});
    case FingerShape::capsule:
      return radius_m + half_length_m * std::sqrt(1.0 + kSpindle * kSpindle);
  }
  return 0.0;
}

double Finger::unroundness_m() const {
  switch (shape) {
    case FingerShape::point:
    case FingerShape::sphere:
      return 0.0;
    case FingerShape::ellipsoid:
      return reach_m() - std::min({semi_axes_m.x, semi_axes_m.y, semi_axes_m.z});
    case FingerShape::capsule:
      return reach_m() - radius_m;
  }
  return 0.0;
}

double Finger::tilt_rad() const {
  const double inner = reach_m() - unroundness_m();
  if (unroundness_m() <= 0.0) return 0.0;
  // The support point lies within the reach, its tangent plane no nearer than the inner radius.
  const double tilt = std::acos(std::clamp(inner / reach_m(), 0.0, 1.0));
  return std::min(1.2 * tilt + 0.05, 3.1);
}

Vec3 core_axes_m(const Finger& finger) {
  if (finger.shape == FingerShape::ellipsoid) return finger.semi_axes_m;
  if (finger.shape != FingerShape::capsule) return Vec3(0.0);
  return finger.half_length_m * Vec3(std::sqrt(1.0 + kSpindle * kSpindle), kSpindle, kSpindle);
}

Support support_with_derivative(const Finger& finger, const FingerPose& pose, const Vec3& normal) {
  switch (finger.shape) {
    case FingerShape::point:
      return {pose.position, Mat3(0.0)};
    case FingerShape::sphere:
      return {pose.position - finger.radius_m * normal, Mat3(-finger.radius_m)};
    case FingerShape::ellipsoid:
      return ellipsoid_support(finger, pose, normal);
    case FingerShape::capsule:
      return capsule_support(finger, pose, normal);
  }
  return {pose.position, Mat3(0.0)};
}

Vec3 support_point(const Finger& finger, const FingerPose& pose, const Vec3& normal) {
  if (finger.shape == FingerShape::ellipsoid) return ellipsoid_support_point(finger, pose, normal);
  if (finger.shape == FingerShape::capsule) return capsule_support_point(finger, pose, normal);
  return support_with_derivative(finger, pose, normal).point;
}

/// Arc on a sphere, or +-limit_m where it is longer: an angle is larger than its sine, and larger than a right angle
/// on the nail's side.
static double sphere_arc(double radius, const Vec2& m, double limit_m) {
  const double across = radius * m.x;
  const bool beyond =
      m.y > 0.0 ? limit_m < 1.5 * radius : across * across > limit_m * limit_m * (m.x * m.x + m.y * m.y);
  return beyond ? std::copysign(limit_m, m.x) : radius * arc_tangent(m.x, -m.y);
}

double contact_arc_m(const Finger& finger, const FingerSection& section, const Vec3& normal, double limit_m) {
  const Vec2 m(-glm::dot(section.distal, normal),
               -glm::dot(section.dorsal, normal));  // to the contact: distal, and to the nail
  if (finger.shape == FingerShape::sphere) return sphere_arc(finger.radius_m, m, limit_m);
  if (m.x == 0.0 && m.y == 0.0) return 0.0;
  const Vec3& a = finger.semi_axes_m;
  switch (finger.shape) {
    case FingerShape::point:
    case FingerShape::sphere:
      return 0.0;
    case FingerShape::ellipsoid:
      return ellipse_arc(a.x, a.z, std::atan2(a.x * m.x, -a.z * m.y));
    case FingerShape::capsule: {
      // Along the straight pad, round the tip, and on the nail side back along the straight part.
      const double within = std::hypot(m.x, m.y);  // the part of the unit normal in the section
      double straight = finger.half_length_m * m.x / std::hypot(m.x, kSpindle * within);
      if (m.y > 0.0) straight = std::copysign(2.0 * finger.half_length_m / std::hypot(1.0, kSpindle), m.x) - straight;
      return finger.radius_m * std::atan2(m.x, -m.y) + straight;
    }
  }
  return 0.0;
}

PlaneContact contact_of_support(const Finger& finger, const FingerPose& pose, const Vec3& point, const Vec3& normal) {
  PlaneContact c;
  const Vec3 d = support_point(finger, pose, normal) - point;
  const double above = glm::dot(d, normal);
  c.penetration_m = -above;
  c.height_m = glm::dot(pose.position - point, normal);
  c.travel = d - above * normal;
  c.error_m = std::sqrt(glm::dot(c.travel, c.travel));
  return c;
}

Mat3 offset_derivative(const Finger& finger, const FingerPose& pose, const Vec3& normal, double penetration_m) {
  if (finger.shape == FingerShape::point) return Mat3(-penetration_m);
  if (finger.shape == FingerShape::sphere) return Mat3(finger.radius_m - penetration_m);
  return -(support_with_derivative(finger, pose, normal).by_normal + Mat3(penetration_m));
}

}  // namespace tangent
