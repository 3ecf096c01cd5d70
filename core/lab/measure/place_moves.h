// What a tick does at one place of the smooth surface: the finger rests there, pressed in, and moves by one tick's
// travel, in several tangential directions and once straight in. Each move is one tick of core/tick/step.h from that
// kept plane, without a search for deeper places, so that it shows the iteration only. Pure.
#pragma once

#include "core/surface/pn_patch.h"
#include "core/tick/step.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tangent {

struct MoveOptions {
  unsigned directions = 8;  ///< tangential moves, at least 1; one straight in is added
  double press_m = 1e-3;    ///< depth of the resting finger
  double move_m = 1e-4;     ///< travel of one tick: 0.1 m/s at 1 kHz
  bool operator==(const MoveOptions&) const = default;
};

/// The finger at rest at a place, on which moves start.
struct RestingFinger {
  SurfaceSample place;  ///< local coordinates
  FingerPose pose;      ///< local coordinates
  TickState kept;
};

/// At (u, v) of a usable triangle, whose patch is `patch`. Empty: the finger can't rest there (the contact is unstable,
/// as in grooves tighter than the finger).
std::optional<RestingFinger> rest_at(const PnPatch& patch, std::uint32_t triangle, double u, double v,
                                     const Finger& finger, double press_m);

/// Unit direction of move `i` <= options.directions in world and mesh axes; the last one is straight in.
Vec3 move_direction(const SurfaceSample& place, const MoveOptions& options, unsigned i);
/// The pose after it, world frame.
TickInput moved(const ContactMesh& mesh, const RestingFinger& resting, const MoveOptions& options, unsigned i);

struct PlaceMove {
  Vec3 direction{0.0};
  TickInput input;
  TickState kept;  ///< before the tick
  TickOutput output;
  bool failed() const { return !is_converged(output.status) || output.event == TickEvent::reseed; }
};

/// All moves from a place. Empty where the finger can't rest. Precondition: the triangle is usable.
std::vector<PlaceMove> solve_moves(Stepper& stepper, const Preset& preset, std::uint32_t triangle, double u, double v,
                                   const MoveOptions& options);
/// The move that fails, or takes the most planes; the first of equals. Precondition: not empty.
std::size_t worst_move(const std::vector<PlaceMove>& moves);

}  // namespace tangent
