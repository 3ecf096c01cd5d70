// Runs a bring-up on a device.
#pragma once

#include "workbench/bringup/bring_up.h"
#include "workbench/bringup/guided_runner.h"

namespace tangent {

using BringUpRunner = GuidedRunner<BringUp>;  // guided_runner.cpp
using BringUpRunOptions = GuidedRunOptions<BringUp>;

}  // namespace tangent
