// A checksum of 64 bits that is the same everywhere: FNV-1a (Fowler, Noll & Vo). It finds accidents, not intent.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace tangent {

/// 16 hex digits.
inline std::string hex_text(std::uint64_t value) {
  std::string out(16, '0');
  for (std::size_t i = out.size(); i-- > 0; value >>= 4) out[i] = "0123456789abcdef"[value & 15];
  return out;
}

/// Fed in parts.
class Fnv {
 public:
  static constexpr std::uint64_t kStart = 0xcbf29ce484222325u, kPrime = 0x100000001b3u;

  Fnv& add(std::string_view bytes) {
    for (const char c : bytes) add_byte(static_cast<unsigned char>(c));
    return *this;
  }
  /// Eight bytes, the lowest first.
  Fnv& add_bits(std::uint64_t bits) {
    for (int i = 0; i < 64; i += 8) add_byte(bits >> i & 0xffu);
    return *this;
  }
  Fnv& add_bits(double value) { return add_bits(std::bit_cast<std::uint64_t>(value)); }
  std::uint64_t value() const { return value_; }
  std::string text() const { return hex_text(value_); }

 private:
  void add_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * kPrime; }
  std::uint64_t value_ = kStart;
};

}  // namespace tangent
