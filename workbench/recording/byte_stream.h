// Plain values as bytes and back, little-endian, one after the other. One description of a type serves both ways:
//   template <class Stream> void describe(Stream& stream, T& value) { stream(value.a); stream(value.b); }
#pragma once

#include "core/base/fnv.h"
#include "core/base/vec.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tangent {

static_assert(std::endian::native == std::endian::little);

class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(const T& value) {
    const auto* from = reinterpret_cast<const unsigned char*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof(T));
  }
  void operator()(const Vec2& v) { all(v.x, v.y); }
  void operator()(const Vec3& v) { all(v.x, v.y, v.z); }
  void operator()(const Quat& q) { all(q.w, q.x, q.y, q.z); }
  /// A number of them, then they.
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    const auto* from = reinterpret_cast<const unsigned char*>(values.data());
    bytes_.insert(bytes_.end(), from, from + values.size() * sizeof(T));
  }
  template <class... T>
  void all(const T&... values) {
    ((*this)(values), ...);
  }
  std::vector<unsigned char> take() { return std::move(bytes_); }

 private:
  std::vector<unsigned char> bytes_;
};

/// Past the end it gives zeros and is no longer good.
class ByteReader {
 public:
  explicit ByteReader(std::span<const unsigned char> bytes) : left_(bytes) {}
  bool good() const { return good_; }
  bool done() const { return good_ && left_.empty(); }

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(T& value) {
    value = T{};
    copy(&value, sizeof(T));
  }
  void operator()(Vec2& v) { all(v.x, v.y); }
  void operator()(Vec3& v) { all(v.x, v.y, v.z); }
  void operator()(Quat& q) { all(q.w, q.x, q.y, q.z); }
  template <class T>
  void operator()(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t count = 0;
    (*this)(count);
    good_ = good_ && count <= left_.size() / sizeof(T);  // before memory is asked for
    values.assign(good_ ? static_cast<std::size_t>(count) : 0, T{});
    copy(values.data(), values.size() * sizeof(T));
  }
  template <class... T>
  void all(T&... values) {
    ((*this)(values), ...);
  }

 private:
  void copy(void* to, std::size_t size) {
    good_ = good_ && size <= left_.size();
    if (!good_ || size == 0) return;
    std::memcpy(to, left_.data(), size);
    left_ = left_.subspan(size);
  }

  std::span<const unsigned char> left_;
  bool good_ = true;
};

inline bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
/// The same bits as SQLite's kind of integer.
inline std::int64_t whole_of(std::uint64_t bits) { return std::bit_cast<std::int64_t>(bits); }

/// 64 bits of any bytes.
inline std::uint64_t hash_of(std::span<const unsigned char> bytes) {
  return Fnv().add({reinterpret_cast<const char*>(bytes.data()), bytes.size()}).value();
}

}  // namespace tangent
