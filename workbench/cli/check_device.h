// workbench devices --check NAME: a guided bring-up (workbench/bringup/) at the terminal, or by lines of a pipe.
#pragma once

#include "core/base/result.h"
#include "devices/device_set.h"

#include <filesystem>
#include <string>

namespace tangent {

struct DeviceCheck {
  std::string kind;  ///< of --force; empty: none is checked
  DeviceOptions drivers;
  std::filesystem::path out;      ///< of the protocol; empty: none is written
  std::filesystem::path packets;  ///< every USB packet is logged there; empty: none is
  double most_n = 1.0;            ///< limit of the forces
  bool without_waiting = false;   ///< in simulated time
};

/// The exit code: kDone if all was proved. Fails on an answer that is none, and a protocol that can't be written.
Result<int> check_device(const DeviceCheck& check);

}  // namespace tangent
