#include "devices/cld/cld_frame.h"

#include <algorithm>

namespace tangent {

namespace {

std::uint16_t read_u16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[0] | (static_cast<unsigned>(at[1]) << 8));
}

void write_u16(std::uint8_t* at, std::uint16_t value) {
  at[0] = static_cast<std::uint8_t>(value & 0xffu);
  at[1] = static_cast<std::uint8_t>(value >> 8);
}

}  // namespace

std::uint16_t cld_crc(std::span<const std::uint8_t> bytes) noexcept {
  std::uint32_t crc = 0xffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<std::uint32_t>(byte) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000u) != 0 ? ((crc << 1) ^ 0x1021u) : crc << 1;
    crc &= 0xffffu;
  }
  return static_cast<std::uint16_t>(crc);
}

std::size_t encode_frame(const CldFrame& frame, std::span<std::uint8_t> out) noexcept {
  out[0] = kCldSync;
  out[1] = frame.version;
  out[2] = frame.type;
  out[3] = frame.length;
  write_u16(&out[4], frame.sequence);
  std::copy_n(frame.payload.begin(), frame.length, out.begin() + kCldHeaderBytes);
  const std::size_t end = kCldHeaderBytes + frame.length;
  write_u16(&out[end], cld_crc(out.subspan(1, end - 1)));
  return end + kCldCrcBytes;
}

// --- Parser --------------------------------------------------------------------------------------------

void CldParser::drop(std::size_t bytes) noexcept {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(bytes), buffer_.begin() + static_cast<std::ptrdiff_t>(held_),
            buffer_.begin());
  held_ -= bytes;
}

// Invariant between calls: the buffer holds the beginning of a frame, or nothing.
std::optional<CldFrame> CldParser::next() noexcept {
  for (;;) {
    const auto begin = buffer_.begin(), end = begin + static_cast<std::ptrdiff_t>(held_);
    const auto before = static_cast<std::size_t>(std::find(begin, end, kCldSync) - begin);
    if (before > 0) {
      counts_.skipped_bytes += before;
      drop(before);
    }
    if (held_ < kCldHeaderBytes) return std::nullopt;
    const std::size_t length = buffer_[3];
    if (length > kCldLargestPayload) {
      ++counts_.wrong_lengths;
      ++counts_.skipped_bytes;
      drop(1);
      continue;
    }
    const std::size_t body = kCldHeaderBytes + length, whole = body + kCldCrcBytes;
    if (held_ < whole) return std::nullopt;
    if (cld_crc({buffer_.data() + 1, body - 1}) != read_u16(&buffer_[body])) {
      ++counts_.crc_errors;
      ++counts_.skipped_bytes;
      drop(1);
      continue;
    }
    CldFrame frame{.version = buffer_[1],
                   .type = buffer_[2],
                   .sequence = read_u16(&buffer_[4]),
                   .length = static_cast<std::uint8_t>(length)};
    std::copy_n(buffer_.begin() + kCldHeaderBytes, length, frame.payload.begin());
    ++counts_.frames;
    drop(whole);
    return frame;
  }
}

std::optional<CldFrame> CldParser::feed(std::uint8_t byte) noexcept {
  buffer_[held_++] = byte;  // has room: next() takes or drops a full buffer before it returns
  return next();
}

// --- Sequence ------------------------------------------------------------------------------------------

CldSequence::Arrival CldSequence::add(std::uint16_t sequence) noexcept {
  if (!known_) {
    known_ = true;
    newest_ = sequence;
    seen_ = 1;
    return Arrival::in_order;
  }
  const auto ahead = static_cast<std::int16_t>(static_cast<std::uint16_t>(sequence - newest_));
  if (ahead > 0) {
    seen_ = ahead < 64 ? (seen_ << ahead) | 1u : 1u;
    newest_ = sequence;
    lost_ += static_cast<std::uint64_t>(ahead - 1);
    return ahead == 1 ? Arrival::in_order : Arrival::after_loss;
  }
  const int behind = -static_cast<int>(ahead);
  const bool came = behind < 64 && ((seen_ >> behind) & 1u) != 0;
  if (came) {
    ++doubled_;
    return Arrival::doubled;
  }
  ++late_;
  if (behind < 64) {
    seen_ |= std::uint64_t{1} << behind;
    if (lost_ > 0) --lost_;
  }
  return Arrival::late;
}

}  // namespace tangent
