// How the simulated hand moves.
#pragma once

#include "core/base/vec.h"

#include <cstdint>

namespace tangent {

enum class HandMode : std::uint8_t {
  explore,  ///< along the exploration path over the mesh
  point,    ///< to a point that a person sets
};

inline constexpr double kFastestHand = 0.5;  // m/s, along the path

struct HandSettings {
  HandMode mode = HandMode::explore;
  double speed_m_per_s = 0.1;  ///< along the path, 0 to kFastestHand; 0: rests
  double press_m = 2.25e-3;    ///< how far inside the surface the hand aims: with a hand of 400 N/m and a contact of
                               ///< 800 N/m the finger rests a third of it deep
  bool operator==(const HandSettings&) const = default;
};

/// What the servo is told.
struct HandCommand {
  HandSettings settings;
  Vec3 point_m{0.0};  ///< HandMode::point, world
};

}  // namespace tangent
