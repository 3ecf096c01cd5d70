// Fields of a message <-> payload of a frame, from one list of members in wire order: encoding, decoding and length are
// all derived from it. For the sources of codecs alone; included nowhere else.
#pragma once

#include "devices/cld/cld_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>

namespace tangent {

/// Little-endian; enumerations as their underlying integer, arrays element by element.
template <class T>
void cld_put(CldFrame& frame, const T& value) noexcept {
  if constexpr (std::is_enum_v<T>) {
    cld_put(frame, static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::is_integral_v<T>) {
    const auto bits = static_cast<std::uint64_t>(static_cast<std::make_unsigned_t<T>>(value));
    for (std::size_t i = 0; i < sizeof(T); ++i)
      frame.payload[frame.length++] = static_cast<std::uint8_t>((bits >> (8 * i)) & 0xffu);
  } else {
    for (const auto& element : value) cld_put(frame, element);
  }
}

template <class T>
void cld_take(const CldFrame& frame, std::size_t& at, T& value) noexcept {
  if constexpr (std::is_enum_v<T>) {
    std::underlying_type_t<T> number{};
    cld_take(frame, at, number);
    value = static_cast<T>(number);
  } else if constexpr (std::is_integral_v<T>) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= static_cast<std::uint64_t>(frame.payload[at++]) << (8 * i);
    value = static_cast<T>(static_cast<std::make_unsigned_t<T>>(bits));
  } else {
    for (auto& element : value) cld_take(frame, at, element);
  }
}

template <class M, class Fields>
CldFrame cld_written(std::uint8_t type, const M& message, const Fields& fields, std::uint16_t sequence) noexcept {
  CldFrame frame{.type = type, .sequence = sequence};
  std::apply([&](auto... field) { (cld_put(frame, message.*field), ...); }, fields);
  return frame;
}

/// Empty when the frame has another version, type or length.
template <class M, class Fields>
std::optional<M> cld_read(std::uint8_t type, const CldFrame& frame, const Fields& fields) noexcept {
  M message;
  const std::size_t length = std::apply([&](auto... field) { return (sizeof(message.*field) + ...); }, fields);
  if (frame.version != kCldVersion || frame.type != type || frame.length != length) return std::nullopt;
  std::size_t at = 0;
  std::apply([&](auto... field) { (cld_take(frame, at, message.*field), ...); }, fields);
  return message;
}

}  // namespace tangent
