// What goes into one haptic tick, what comes out, and what one tick hands to the next: plain data.
#pragma once

#include "core/contact/clearance.h"
#include "core/contact/decide/tick_event.h"
#include "core/contact/tracked_plane.h"
#include "core/finger/finger.h"
#include "core/shading/blend.h"

#include <cstdint>

namespace tangent {

/// `free`: not touching: out of reach of the surface, or behind a place that was never entered from outside.
enum class TickStatus : std::uint8_t { free, face, edge, vertex, unconverged };
const char* to_string(TickStatus status);
/// Of a converged contact: `free` where the finger does not reach the surface.
TickStatus status_of(Feature feature, double penetration_m);

/// What is rendered on while no contact is found.
struct ConvergedPlane {
  Vec3 point{0.0};  ///< local, m
  Vec3 normal{0.0, 0.0, 1.0};
};

/// Everything one tick hands to the next. Trivially copyable.
struct TickState {
  TrackedPlane plane;             ///< feature none: nothing tracked yet
  ConvergedPlane last_converged;  ///< of the last converged tick, if has_converged
  double last_converged_s = 0.0;  ///< its time
  Vec3 last_position{0.0};        ///< finger position of the previous tick, world, m
  double last_t_s = 0.0;
  std::uint8_t has_previous = 0;   ///< last_position and last_t_s are set
  std::uint8_t has_converged = 0;  ///< there was a converged tick
  Clearance clearance;
  Vec3 proxy{0.0};  ///< of the two-pass method, local, m
  std::uint8_t has_proxy = 0;
  std::uint8_t unentered = 0;  ///< the tracked place was found from behind: it does not push until it is left
  RenderedState rendered;
};

struct TickInput {
  double t_s = 0.0;
  FingerPose finger;
};

/// One row of ticks.csv. World frame, SI.
struct TickOutput {
  TickStatus status = TickStatus::unconverged;
  TickEvent event = TickEvent::none;
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
  Vec3 contact{0.0};
  Vec3 normal{0.0, 0.0, 1.0};
  double penetration_m = 0.0;
  Vec3 force_n{0.0};
  double cld_m = 0.0;
  double error_m = 0.0;
  std::int32_t iterations = 0;  ///< surface evaluations of this tick, seeds included
  std::int32_t triangle_changes = 0;
  Vec3 decided_force_n{0.0};  ///< force and display before they were blended with those of the last tick
  double decided_cld_m = 0.0;
};

/// What crosses the rings from the servo to its watchers: enough to compute the tick again.
struct TickRecord {
  std::uint64_t tick = 0;
  std::uint32_t preset_id = 0;
  TickState kept;  ///< the state before the tick
  TickInput input;
  TickOutput output;
  double solve_ns = 0.0;
};

}  // namespace tangent
