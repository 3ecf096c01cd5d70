// Which way a hand moved, against which way the device says it did. The world (devices/placement.h): x away from the
// person, y to the left, z up. The person is asked to move away, to the right, and up.
#pragma once

#include "devices/placement.h"
#include "workbench/bringup/bring_up_facts.h"

#include <optional>
#include <string>

namespace tangent {

/// In the world: away from the person, to the right, up.
Vec3 asked_direction(std::size_t motion) noexcept;
/// 1, 2, 3: along x, y, z; negative: against; 0: too short (10 mm), or along two axes alike (the second above 0.7 of
/// the first).
int signed_axis(const Vec3& moved_m) noexcept;
/// Why a motion of about `asked_m` can't be judged; none: it can.
BringUpWhy motion_problem(const Vec3& moved_m, double asked_m) noexcept;

/// "x reads the motion to the right as away ..." and the frame, or the sign in the driver, that mends it; empty: all
/// motions are read as they were made.
std::string axes_text(const std::array<MotionFacts, 3>& motions, const DeviceFrame& frame);
/// The frame under which every motion is read as it was made; none: no rotation does it, or too few motions are known.
std::optional<DeviceFrame> mending_frame(const std::array<MotionFacts, 3>& motions, const DeviceFrame& frame);

/// "to the right", "to the left", "away from you", "towards you", "up", "down"; `direction`: in the world.
const char* direction_text(const Vec3& direction) noexcept;

}  // namespace tangent
