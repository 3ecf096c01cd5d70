// Where an Inverse Service is.
#pragma once

#include "core/base/result.h"

#include <string>

namespace tangent {

struct HaplyAddress {
  std::string host, port;
};

/// "ws://HOST", "ws://HOST:PORT" (default 10001), "ws://[::1]:PORT". Fails on anything else, and on a host that is not
/// this machine unless `other_host`.
Result<HaplyAddress> read_haply_address(const std::string& text, bool other_host);

}  // namespace tangent
