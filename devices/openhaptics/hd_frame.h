// Units and axes of OpenHaptics to those of the project, and what it says of a device to what we say of one.
//
// HDAPI (OpenHaptics Programmer's Guide, "Cartesian space"): x to the right, y up, z to the person, in mm from an
// origin of the device's own. Our device frame keeps these axes, in metres from the centre of the usable workspace; the
// frame in the capabilities turns them into the world (x away from the person, y left, z up). The stylus' own frame is
// that of the device when the stylus points away from the person, level: its z is from the tip to the end of the
// handle.
#pragma once

#include "devices/force_device.h"
#include "devices/openhaptics/hd_api.h"

#include <array>
#include <string>

namespace tangent::hd {

/// Lowest and highest corner, mm, as HD_USABLE_WORKSPACE_DIMENSIONS gives them.
using Corners = std::array<double, 6>;

/// Turns HDAPI's axes into the world's; also the stylus' frame into the finger's.
DeviceFrame device_frame();
/// Of a box, in metres and HDAPI's axes: its centre, and half its size. Zero where a corner is not finite or no box.
Vec3 centre_m(const Corners& box_mm);
Vec3 half_size_m(const Corners& box_mm);

/// Device frame, metres. `centre_m`: of the workspace.
Vec3 position_m(const double mm[3], const Vec3& centre_m);
Vec3 velocity_m_per_s(const double mm_per_s[3]);
/// Finger frame -> device frame, unit, from HD_CURRENT_TRANSFORM (16, column after column). Precondition: is_rotation.
Quat orientation(const double transform[16]);
/// Whether its upper left 3 x 3 is one, within 1e-2: what a lying device sends seldom is.
bool is_rotation(const double transform[16]) noexcept;

/// The capabilities of the device of the current frame, or the one that was initialised last. What it does not say is
/// 0.
ForceCapabilities read_capabilities(const Api& api);

}  // namespace tangent::hd
