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

/// The hand's settings and target as sent to the servo.
struct HandCommand {
  HandSettings settings;
  Vec3 point_m{0.0};  ///< HandMode::point, world
};

}  // namespace tangent
