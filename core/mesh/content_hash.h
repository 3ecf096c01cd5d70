// 64-bit FNV-1a (Fowler, Noll, Vo) over the bytes of vectors and indices, little endian, to name a mesh's content.
#pragma once

#include "core/base/vec.h"
#include "core/mesh/fan_walk.h"

#include <bit>
#include <cstdint>
#include <span>

namespace tangent {

class ContentHash {
 public:
  void add(std::span<const Vec3> vectors) { add_bytes(std::as_bytes(vectors)); }
  void add(std::span<const Index3> indices) {
    std::uint64_t h = value_;
    for (const Index3& words : indices)
      for (const std::uint32_t word : words) {
        h = (h ^ (word & 0xFFu)) * kPrime;
        h = (h ^ (word >> 8 & 0xFFu)) * kPrime;
        // A byte of zero only multiplies, here together with the one before.
        h = word >> 24 == 0 ? (h ^ word >> 16) * (kPrime * kPrime)
                            : ((h ^ (word >> 16 & 0xFFu)) * kPrime ^ word >> 24) * kPrime;
      }
    value_ = h;
  }
  std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001B3u;
  static_assert(std::endian::native == std::endian::little && sizeof(Vec3) == 24 && sizeof(Index3) == 12);

  void add_bytes(std::span<const std::byte> bytes) {
    std::uint64_t h = value_;
    for (const std::byte b : bytes) h = (h ^ static_cast<std::uint8_t>(b)) * kPrime;
    value_ = h;
  }

  std::uint64_t value_ = 0xCBF29CE484222325u;
};

}  // namespace tangent
