#include "core/mesh/weld.h"

#include <algorithm>
#include <array>
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

/// Vectors are welded in two parts, told by a bit of their hash: equal ones are in the same.
constexpr std::uint64_t hash_part(std::uint64_t hash) { return hash >> 43; }

/// Sets `same[i]`, of the vectors of one part, to the first one that is equal; kNone where it is left out.
void find_first(std::span<const Vec3> vectors, double largest, std::uint64_t part, std::span<std::uint32_t> same) {
  // Open addressing; half of the vectors are in either part, so it is at most half full, and never full. Slots are
  // looked up at random in a table larger than the caches, so a block of them is fetched ahead: 15.7M corners of an
  // icosphere took 0.51 s without and 0.31 s with it.
  const std::size_t mask = std::bit_ceil(std::max<std::size_t>(16, vectors.size() + 1)) - 1;
  std::vector<std::uint32_t> table(mask + 1, kNone);
  constexpr std::size_t kBlock = 64;
  std::array<std::uint64_t, kBlock> hashes;
  for (std::size_t begin = 0; begin < vectors.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, vectors.size());
    for (std::size_t i = begin; i < end; ++i) {
      hashes[i - begin] = hash(vectors[i]);
      if (hash_part(hashes[i - begin]) == part) __builtin_prefetch(&table[hashes[i - begin] & mask], 1);
    }
    for (std::size_t i = begin; i < end; ++i) {
      if (hash_part(hashes[i - begin]) != part) continue;
      same[i] = kNone;
      if (!within(vectors[i], largest)) continue;
      std::size_t slot = hashes[i - begin] & mask;
      while (table[slot] != kNone && vectors[table[slot]] != vectors[i]) slot = (slot + 1) & mask;
      if (table[slot] == kNone) table[slot] = static_cast<std::uint32_t>(i);
      same[i] = table[slot];
    }
  }
}

}  // namespace

Weld weld_exact(std::span<const Vec3> vectors, double largest, const RunBoth& run_both) {
  Weld weld;
  weld.id.resize(vectors.size());
  run_both([&] { find_first(vectors, largest, 0, weld.id); }, [&] { find_first(vectors, largest, 1, weld.id); });
  for (std::uint32_t i = 0; i < weld.id.size(); ++i) {
    const std::uint32_t first = weld.id[i];
    if (first == kNone) continue;
    weld.id[i] = first == i ? weld.count() : weld.id[first];
    if (first == i) weld.first.push_back(i);
  }
  return weld;
}

}  // namespace tangent
