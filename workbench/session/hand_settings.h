// Settings of the simulated hand.
#pragma once

#include "core/base/vec.h"

#include <cstdint>

namespace tangent {

enum class HandMode : std::uint8_t {
  explore,  ///< along the exploration path over the mesh
  point,    ///< to a point set by the user
};

inline constexpr double kFastestHand = 0.5;  // m/s, along the path

struct HandSettings {
  HandMode mode = HandMode::explore;
  double speed_m_per_s = 0.1;  ///< along the path, 0 to kFastestHand
  double press_m = 2.25e-3;    ///< depth of the hand's target inside the surface: with a hand of 400 N/m and a
                               ///< contact of 800 N/m the finger rests at a third of it
  bool operator==(const HandSettings&) const = default;
};

/// A hand that the mouse leads: as a person goes to a place that was pointed at, and pulling with at most 1.2 N (by a
/// hand of 400 N/m) where the surface is in the way.
inline constexpr double kMouseSpeed = 0.2;  // m/s
inline constexpr double kMouseLead_m = 3e-3;

/// The hand's settings and target as sent to the servo.
struct HandCommand {
  HandSettings settings;
  Vec3 point_m{0.0};                 ///< HandMode::point, world
  double point_speed_m_per_s = 1.0;  ///< on the way to it
  double longest_lead_m = 1.0;       ///< how far ahead of the finger the hand's target may be
};

}  // namespace tangent
