#include "core/mesh/weld.h"

#include <algorithm>
#include <bit>

namespace tangent {
namespace {

std::uint64_t hash(const Vec3& p) {
  // Adding 0.0 turns -0.0 into 0.0, which must meet in one slot.
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
  std::uint64_t h = bits(p.x) * 0x9E3779B97F4A7C15u;
  h = (std::rotl(h, 29) ^ bits(p.y)) * 0xBF58476D1CE4E5B9u;
  h = (std::rotl(h, 29) ^ bits(p.z)) * 0x94D049BB133111EBu;
  h ^= h >> 32;  // the slot is taken from the low bits, the entropy of a product sits high
  return h * 0x9E3779B97F4A7C15u >> 20;
}

bool within(const Vec3& p, double largest) {  // false for NaN
  return std::abs(p.x) <= largest && std::abs(p.y) <= largest && std::abs(p.z) <= largest;
}

}  // namespace

Weld weld_exact(std::span<const Vec3> vectors, double largest) {
  Weld weld;
  weld.id.assign(vectors.size(), kNone);
  // Open addressing, at most half full. Slots are looked up at random in a table larger than the caches, so a block
  // of them is fetched ahead: 15.7M corners of an icosphere took 0.51 s without and 0.31 s with it.
  const std::size_t mask = std::bit_ceil(std::max<std::size_t>(16, 2 * vectors.size())) - 1;
  std::vector<std::uint32_t> table(mask + 1, kNone);
  constexpr std::size_t kBlock = 64;
  std::uint64_t slots[kBlock];
  for (std::size_t begin = 0; begin < vectors.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, vectors.size());
    for (std::size_t i = begin; i < end; ++i) {
      slots[i - begin] = hash(vectors[i]) & mask;
      __builtin_prefetch(&table[slots[i - begin]], 1);
    }
    for (std::size_t i = begin; i < end; ++i) {
      if (!within(vectors[i], largest)) continue;
      std::size_t slot = slots[i - begin];
      while (table[slot] != kNone && vectors[weld.first[table[slot]]] != vectors[i]) slot = (slot + 1) & mask;
      if (table[slot] == kNone) {
        table[slot] = weld.count();
        weld.first.push_back(static_cast<std::uint32_t>(i));
      }
      weld.id[i] = table[slot];
    }
  }
  return weld;
}

}  // namespace tangent
