// The Falcon's firmware, which is its maker's: a file that the owner names. It is loaded into the device's memory at
// every power-up, so a wrong one does no lasting harm, but it drives motors: only a file that is known is sent.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tangent {

struct FalconFirmware {
  std::vector<std::uint8_t> bytes;
  std::string sha256;      ///< 64 digits
  bool published = false;  ///< its digest is in our list; otherwise the owner confirmed it
};

/// Of a file (1 to 64 KiB) whose SHA-256 is in our list, or is `confirmed_sha256`, that of the owner, in either case of
/// letters. Fails on any other and says its digest.
Result<FalconFirmware> read_falcon_firmware(const std::filesystem::path& file, const std::string& confirmed_sha256);

}  // namespace tangent
