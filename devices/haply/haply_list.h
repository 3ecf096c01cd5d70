// The Inverse3 devices that an Inverse Service lists, which it does as soon as somebody connects: nothing is sent, and
// nothing moves.
#pragma once

#include "core/base/result.h"
#include "devices/found_device.h"
#include "devices/haply/haply_options.h"

#include <vector>

namespace tangent {

/// Blocks for connect_s at most. Fails when no service answers, or it was not built in.
Result<std::vector<FoundDevice>> list_haply_devices(const HaplyOptions& options);

}  // namespace tangent
