// SHA-256 (FIPS 180-4) of bytes in memory, to name a file whose content matters. Allocates nothing but its text.
//
// Our own, since it is all that the drivers would need of a library: what Debian has (libcrypto 4.7 MB, nettle 0.3 MB)
// would have to be there for every build and package, and nothing here is secret.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace tangent {

std::array<std::uint8_t, 32> sha256(std::span<const std::uint8_t> bytes) noexcept;

/// 64 hexadecimal digits, lower case.
std::string sha256_text(std::span<const std::uint8_t> bytes);

}  // namespace tangent
