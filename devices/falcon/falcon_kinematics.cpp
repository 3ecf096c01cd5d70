#include "devices/falcon/falcon_kinematics.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

// Lengths in metres, by Stamper's letters.
constexpr double kA = 0.060, kB = 0.1025, kC = 0.01443, kD = 0.01125, kE = 0.01125, kF = -0.025, kR = 0.040,
                 kS = -0.02309;
constexpr std::array<double, 3> kLegs_deg{105.0, -15.0, -135.0};
/// Made before the servo runs: a local one would be locked at its first use.
const std::array<Vec2, 3> kLegDirections = [] {
  std::array<Vec2, 3> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double angle = kLegs_deg[i] * std::numbers::pi / 180.0;
    out[i] = {std::cos(angle), std::sin(angle)};
  }
  return out;
}();

/// Of the position, seen from one leg.
struct LegView {
  double x = 0.0, v = 0.0, z = 0.0;  ///< x: u + c - r; v: along the turn, from where the parallelogram is straight
  Vec3 along_u{0.0}, along_v{0.0};   ///< the leg's axes
};

LegView seen_from(std::size_t leg, const Vec3& p) noexcept {
  const Vec2 d = kLegDirections[leg];
  LegView view;
  view.along_u = {d.x, d.y, 0.0};
  view.along_v = {-d.y, d.x, 0.0};
  view.x = glm::dot(view.along_u, p) - kR + kC;
  view.v = glm::dot(view.along_v, p) - kS + kF;
  view.z = p.z;
  return view;
}

/// Reach of the lower leg in the leg's plane, and its derivative along v. False: out of reach.
bool reach(double v, double& length, double& slope) noexcept {
  const double inside = kB * kB - v * v;
  if (!(inside > 0.0)) return false;
  const double root = std::sqrt(inside);
  length = kD + kE + root;
  slope = -v / root;
  return true;
}

/// How far leg `i` is from closing at this angle, and its gradient. False: out of reach.
bool gap(std::size_t i, const Vec3& p, double angle, double& value, Vec3& gradient) noexcept {
  const LegView leg = seen_from(i, p);
  double length = 0.0, slope = 0.0;
  if (!reach(leg.v, length, slope)) return false;
  const double dx = leg.x - kA * std::cos(angle), dz = leg.z - kA * std::sin(angle);
  const double distance = std::hypot(dx, dz);
  if (!(distance > 1e-6)) return false;
  value = distance - length;
  gradient = dx / distance * leg.along_u + Vec3(0.0, 0.0, dz / distance) - slope * leg.along_v;
  return true;
}

}  // namespace

Vec3 falcon_angles(const FalconEncoders& encoders) noexcept {
  return Vec3(kFalconZeroAngle) + kFalconRadiansPerTick * Vec3(encoders[0], encoders[1], encoders[2]);
}

FalconEncoders falcon_encoders(const Vec3& angles) noexcept {
  FalconEncoders out{};
  for (int i = 0; i < 3; ++i) {
    const double ticks = std::round((angles[i] - kFalconZeroAngle) / kFalconRadiansPerTick);
    out[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(std::clamp(ticks, -32768.0, 32767.0));
  }
  return out;
}

// With x, z and L known: a (x cos t + z sin t) = (x^2 + z^2 + a^2 - L^2) / 2. Of the two solutions the knee outside.
std::optional<Vec3> falcon_inverse(const Vec3& p) noexcept {
  Vec3 angles(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const LegView leg = seen_from(i, p);
    double length = 0.0, slope = 0.0;
    if (!reach(leg.v, length, slope)) return std::nullopt;
    const double far2 = leg.x * leg.x + leg.z * leg.z;
    const double cosine = (far2 + kA * kA - length * length) / (2.0 * kA * std::sqrt(far2));
    if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
    angles[static_cast<int>(i)] = std::atan2(leg.z, leg.x) - std::acos(cosine);
  }
  return angles;
}

std::optional<Vec3> falcon_forward(const Vec3& angles, const Vec3& near_m) noexcept {
  constexpr int kMostSteps = 30;
  constexpr double kLongestStep_m = 0.03, kDone_m = 1e-12, kSame_rad = 1e-9;
  if (!is_finite(angles) || !is_finite(near_m)) return std::nullopt;
  Vec3 p = near_m;
  for (int step = 0; step < kMostSteps; ++step) {
    Vec3 gaps(0.0), rows[3];
    for (std::size_t i = 0; i < 3; ++i) {
      if (!gap(i, p, angles[static_cast<int>(i)], gaps[static_cast<int>(i)], rows[i])) return std::nullopt;
    }
    const Mat3 slopes = glm::transpose(Mat3(rows[0], rows[1], rows[2]));
    if (!(std::abs(glm::determinant(slopes)) > 1e-9)) return std::nullopt;
    Vec3 change = -(glm::inverse(slopes) * gaps);
    const double length = std::sqrt(glm::dot(change, change));
    if (length > kLongestStep_m) change *= kLongestStep_m / length;
    p += change;
    if (length > kDone_m) continue;
    const auto back = falcon_inverse(p);
    if (!back) return std::nullopt;
    const Vec3 off = *back - angles;
    if (std::sqrt(glm::dot(off, off)) > kSame_rad) return std::nullopt;
    return p;
  }
  return std::nullopt;
}

// By the implicit function: dt/dp = -(dg/dp) / (dg/dt), dg/dt = a (dx sin t - dz cos t) / distance.
std::optional<Mat3> falcon_jacobian(const Vec3& p) noexcept {
  const auto angles = falcon_inverse(p);
  if (!angles) return std::nullopt;
  Vec3 rows[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = (*angles)[static_cast<int>(i)];
    double value = 0.0;
    Vec3 gradient(0.0);
    if (!gap(i, p, t, value, gradient)) return std::nullopt;
    const LegView leg = seen_from(i, p);
    const double dx = leg.x - kA * std::cos(t), dz = leg.z - kA * std::sin(t);
    const double by_angle = kA * (dx * std::sin(t) - dz * std::cos(t)) / std::hypot(dx, dz);
    if (!(std::abs(by_angle) > 1e-4 * kA)) return std::nullopt;
    rows[i] = gradient / -by_angle;
  }
  return glm::transpose(Mat3(rows[0], rows[1], rows[2]));
}

std::optional<Vec3> falcon_torques(const Vec3& p, const Vec3& force_n) noexcept {
  const auto jacobian = falcon_jacobian(p);
  if (!jacobian) return std::nullopt;
  const Mat3 t = glm::transpose(*jacobian);
  if (!(std::abs(glm::determinant(t)) > 1.0)) return std::nullopt;  // about 1/a^3, 4600, in the middle
  const Vec3 torques = glm::inverse(t) * force_n;
  return is_finite(torques) ? std::optional(torques) : std::nullopt;
}

std::optional<Vec3> falcon_force(const Vec3& p, const Vec3& torques) noexcept {
  const auto jacobian = falcon_jacobian(p);
  if (!jacobian) return std::nullopt;
  return glm::transpose(*jacobian) * torques;
}

bool falcon_plausible(const Vec3& p) noexcept {
  constexpr double kAround_m = 0.035;
  const Vec3 off = p - kFalconCentre_m;
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(off[i]) <= kFalconHalfSize_m[i] + kAround_m)) return false;
  return true;
}

}  // namespace tangent
