// SplitMix numbers that are the same on every machine and with every library: SplitMix64 (Steele, Lea & Flood, "Fast
// Splittable Pseudorandom Number Generators", 2014).
#pragma once

#include <cstdint>
#include <span>
#include <utility>

namespace tangent {

class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}
  /// A stream of its own for each place: of the same seed, other places give unrelated numbers.
  SplitMix(std::uint64_t seed, std::uint64_t place) : state_(SplitMix(seed ^ SplitMix(place).next()).next()) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ z >> 27) * 0x94d049bb133111ebull;
    return z ^ z >> 31;
  }
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }  ///< [0, 1)
  /// [0, n): as fair as 64 bits make it. Precondition: n > 0.
  std::uint64_t below(std::uint64_t n) { return next() % n; }

  /// Every order is as likely as any other (Fisher, Yates).
  template <class T>
  void shuffle(std::span<T> values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace tangent
