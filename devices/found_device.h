// Force devices that are attached, each driver asked for its own: what `workbench devices` lists.
#pragma once

#include "core/base/result.h"

#include <string>
#include <vector>

namespace tangent {

struct DeviceOptions;

/// One that is attached, or set up. Where a driver can't look, as its library is missing: one without name, with the
/// problem.
struct FoundDevice {
  std::string kind;      ///< as --force calls it: "falcon"
  std::string name;      ///< for people: "Novint Falcon on bus 1, address 5"; empty: the driver can't look
  std::string serial;    ///< that tells it from others of its kind; empty: not known
  Error problem = {};    ///< why it can't be opened; `what` empty: it can
  bool attached = true;  ///< false: set up on this machine; only opening it tells whether it is there
  bool can_be_opened() const { return problem.what.empty(); }
};

/// Of every kind of force device, in the order of --force; simulated ones are not looked for. Blocks (it opens each for
/// a moment at most, sends no command, and moves nothing): not in the servo thread.
std::vector<FoundDevice> find_force_devices(const DeviceOptions& options);
/// Whether one of this kind is.
bool is_attached(const std::string& kind, const DeviceOptions& options);
/// The kinds that are looked for.
std::vector<std::string> sought_force_devices();

}  // namespace tangent
