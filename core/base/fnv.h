// A checksum of 64 bits that is the same everywhere: FNV-1a (Fowler, Noll & Vo). It finds accidents, not intent.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tangent {

/// Fed in parts.
class Fnv {
 public:
  Fnv& add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return *this;
  }
  std::uint64_t value() const { return value_; }
  /// 16 hex digits.
  std::string text() const {
    std::string out(16, '0');
    for (std::size_t i = 0; i < out.size(); ++i) out[out.size() - 1 - i] = "0123456789abcdef"[value_ >> 4 * i & 15];
    return out;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace tangent
