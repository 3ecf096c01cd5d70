// What Force Dimension's devices can do, by type, and their axes in the world.
//
// Peak force, stiffness and workspace: what CHAI3D 3.2 (cDeltaDevice, by authors of the SDK) uses for each type; what
// it does not list is 0, not known. Axes (SDK reference): x to the person, y to the right, z up, in metres from the
// centre of the workspace.
#pragma once

#include "devices/force_device.h"

namespace tangent::dhd {

struct Model {
  int type;                   ///< DHD_DEVICE_*, as dhdGetSystemType returns it
  const char* name;           ///< "omega.3"
  double peak_n;              ///< 0: not known
  double stiffness_n_per_m;   ///< largest that it renders stably
  double workspace_radius_m;  ///< of a ball around the origin; 0: not known
};

/// Of a type that is not known: zeros.
const Model& model_of(int type) noexcept;

/// Why one whose peak force is not known gets no force: the library has no function that says it (dhdGetMaxForce
/// returns the limit that a program has set), and nothing that its makers publish in the open names it for every type.
Error peak_not_known(const std::string& device);

/// Turns DHD's axes into the world's.
DeviceFrame device_frame();

/// Finger frame -> device frame, unit, from dhdGetOrientationFrame (rows). The handle's own axes are those of the
/// device where it points away from the person. Precondition: is_rotation.
Quat orientation(const double matrix[3][3]);
/// Whether it is one, within 1e-2.
bool is_rotation(const double matrix[3][3]) noexcept;

}  // namespace tangent::dhd
