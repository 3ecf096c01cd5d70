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
  void add(std::span<const Index3> indices) { add_bytes(std::as_bytes(indices)); }
  std::uint64_t value() const { return value_; }

 private:
  static_assert(std::endian::native == std::endian::little && sizeof(Vec3) == 24 && sizeof(Index3) == 12);

  void add_bytes(std::span<const std::byte> bytes) {
    std::uint64_t h = value_;
    for (const std::byte b : bytes) h = (h ^ static_cast<std::uint8_t>(b)) * 0x100000001B3u;
    value_ = h;
  }

  std::uint64_t value_ = 0xCBF29CE484222325u;
};

}  // namespace tangent
