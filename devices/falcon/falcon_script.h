// Settings of the FTDI chip and the upload of the firmware, as a list of steps. Each begins when the one before was
// answered; none waits: it goes on when `turn`, `heard` or `control_done` is called. Link's thread. Allocates nothing.
#pragma once

#include "devices/falcon/falcon_wire.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace tangent {

/// Why a step failed.
enum class FalconWhy : std::uint8_t { none, refused, silent, wrong_answer };

class FalconScript {
 public:
  enum class State : std::uint8_t { idle, busy, done, failed };

  /// Fastest answers, the baud rate of the firmware, empty buffers.
  void start_run_mode(std::int64_t now_ns) noexcept;
  /// The boot loader's greeting, the firmware in pieces of 62 bytes, each echoed, then as run mode. `firmware` must
  /// outlive it.
  void start_upload(std::span<const std::uint8_t> firmware, std::int64_t now_ns) noexcept;
  void stop() noexcept { state_ = State::idle; }

  void turn(FalconWire& wire, std::int64_t now_ns) noexcept;
  void control_done(bool good, std::int64_t now_ns) noexcept;
  /// Bytes without the FTDI chip's status.
  void heard(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept;

  State state() const { return state_; }
  FalconWhy why() const { return why_; }
  std::size_t step() const { return step_; }
  std::size_t piece() const { return sent_bytes_ / kPiece; }  ///< of the firmware, from 0

  static constexpr std::size_t kPiece = 62;
  static const char* name(std::size_t step);  ///< "the boot loader's greeting"
  static std::size_t step_count();

 private:
  std::span<const std::uint8_t> to_say() const noexcept;
  std::span<const std::uint8_t> to_hear() const noexcept;
  void start(std::size_t first, std::int64_t now_ns) noexcept;
  void next(std::int64_t now_ns) noexcept;
  void fail(FalconWhy why) noexcept;

  std::span<const std::uint8_t> firmware_;
  State state_ = State::idle;
  FalconWhy why_ = FalconWhy::none;
  std::size_t step_ = 0, sent_bytes_ = 0, heard_bytes_ = 0;
  bool sent_ = false, spoilt_ = false;
  int tries_ = 0;
  std::int64_t since_ns_ = 0;
};

}  // namespace tangent
