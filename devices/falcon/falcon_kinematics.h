// Kinematics of the Novint Falcon, a parallel mechanism of three legs (R. E. Stamper, "A three degree of freedom
// parallel manipulator with only translational degrees of freedom", PhD 97-4, University of Maryland, 1997).
//
// Its own axes: origin in the middle of the base, z out of it towards the person, y up, x to the right. SI units,
// radians. A leg's plane is turned about z by its angle; there u points away from the axis and v along the turn:
//   g(p, t) = hypot(u + c - r - a cos t, z - a sin t) - L(v),   L(v) = d + e + sqrt(b^2 - (v - s + f)^2)   = 0
// for the leg's motor angle t. Because of d and e the surface of a leg is no sphere, so the position is found by
// Newton's method on the three g; the angles of a position, and all derivatives, are in closed form.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>

namespace tangent {

using FalconEncoders = std::array<std::int16_t, 3>;

inline constexpr double kFalconRadiansPerTick = 0.036435 * std::numbers::pi / 180.0;
inline constexpr double kFalconZeroAngle = 35.0 * std::numbers::pi / 180.0;  ///< at encoder 0, once homed

/// The middle of the workspace, in the mechanism's axes, and its half size: a box whose every place the legs reach.
inline constexpr Vec3 kFalconCentre_m{0.0, 0.0, 0.12};
inline constexpr Vec3 kFalconHalfSize_m{0.04, 0.04, 0.04};

Vec3 falcon_angles(const FalconEncoders& encoders) noexcept;
/// The nearest ticks; saturated at 16 bits.
FalconEncoders falcon_encoders(const Vec3& angles) noexcept;

/// Motor angles at this position; empty where a leg doesn't reach.
std::optional<Vec3> falcon_inverse(const Vec3& position_m) noexcept;

/// Position of these motor angles, by at most 30 Newton steps from `near_m`, checked by the inverse. Empty when there
/// is none, or none that the mechanism can get to.
std::optional<Vec3> falcon_forward(const Vec3& angles, const Vec3& near_m = kFalconCentre_m) noexcept;

/// d angle / d position: row i is motor i's, rad/m. Empty where a leg doesn't reach or is stretched out.
std::optional<Mat3> falcon_jacobian(const Vec3& position_m) noexcept;

/// Torques about the motor axes (N m) that push with `force_n` at `position_m`: the solution of J^T torque = force, by
/// virtual work (torque . d angle = force . d position). Empty where J is singular.
std::optional<Vec3> falcon_torques(const Vec3& position_m, const Vec3& force_n) noexcept;
/// The force of these torques.
std::optional<Vec3> falcon_force(const Vec3& position_m, const Vec3& torques) noexcept;

/// Whether a finger can be there: the workspace's box and 3.5 cm around it.
bool falcon_plausible(const Vec3& position_m) noexcept;

}  // namespace tangent
