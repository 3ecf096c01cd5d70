// Iterations by the curvature at the contact ("ground"): flat, gently curved, or curved tighter than the finger.
//
// Along a principal direction of curvature k the residual of a unit step is h k, h being about the
// finger's reach: the ideal factor of a step is 1/(1 + h k). Where one principal direction has h k = 13 (a 1.5 mm edge
// under a 20 mm finger) and the other 0, no single factor suits both.
#pragma once

#include "core/tick/step.h"

#include <array>
#include <cstdint>

namespace tangent {

enum class Ground : std::uint8_t {
  flat,    ///< reach * |k| below 0.1 in every direction
  gentle,  ///< between
  tight,   ///< reach * |k| 2 or more in some direction
  sharp,   ///< edge and vertex contacts
};
inline constexpr std::array kGrounds{Ground::flat, Ground::gentle, Ground::tight, Ground::sharp};
inline constexpr double kFlatBelow = 0.1, kTightFrom = 2.0;
const char* to_string(Ground ground);

/// By the principal curvatures of the surface at the tick's contact. Precondition: the tick has a triangle.
Ground ground_of(const ContactMesh& mesh, const Preset& preset, const TickOutput& output);

struct GroundCounts {
  std::array<std::uint64_t, kGrounds.size()> ticks{}, iterations{};

  void add(Ground ground, std::int32_t spent) {
    ++ticks[static_cast<std::size_t>(ground)];
    iterations[static_cast<std::size_t>(ground)] += static_cast<std::uint64_t>(spent);
  }
  double share(Ground ground) const;            ///< of all ticks, 0 to 1
  double mean_iterations(Ground ground) const;  ///< 0 where there are none
};

}  // namespace tangent
