// Notices an exchange with a device that does not return: the servo thread waits in it, so another thread looks, and
// tells the device to stop by its own way (emergency_stop). Two threads, without a lock.
#pragma once

#include "devices/device_set.h"

#include <atomic>
#include <cstdint>

namespace tangent {

enum class ExchangeWith : std::uint8_t { none, force_device, display };
const char* to_string(ExchangeWith device);

class ExchangeWatch {
 public:
  static constexpr std::int64_t kLongest_ns = 12'000'000;  ///< an exchange takes microseconds
  static constexpr std::int64_t kLook_ns = 4'000'000;      ///< between two looks: found within 16 ms and the jitter

  /// `devices` must outlive it.
  explicit ExchangeWatch(DeviceSet& devices) : devices_(devices) {}

  /// Servo thread, around the exchanges; `now_ns` 0: not watched.
  void begin(ExchangeWith device, std::int64_t now_ns) noexcept;
  /// True: it was found hung meanwhile.
  bool end() noexcept;

  /// Watching thread. True: found an exchange that hangs, and told its device to stop.
  bool look(std::int64_t now_ns) noexcept;

  /// Any thread: how long the exchange has lasted that goes on now; 0: none does.
  std::int64_t lasts_ns(std::int64_t now_ns) const noexcept;
  /// Any thread: the device whose exchange hangs now, or hung last.
  ExchangeWith hung() const noexcept { return hung_.load(std::memory_order_acquire); }
  bool hangs_now() const noexcept { return found_.load(std::memory_order_acquire); }
  /// Whether the device had a way to be stopped.
  bool was_stopped() const noexcept { return stopped_.load(std::memory_order_acquire); }

 private:
  DeviceSet& devices_;
  static constexpr int kDeviceBits = 2;
  std::atomic<std::int64_t> began_{0};  ///< ns << kDeviceBits | device: read at once, or the wrong one would be stopped
  std::atomic<ExchangeWith> hung_{ExchangeWith::none};
  std::atomic<bool> found_{false}, stopped_{false};
};

}  // namespace tangent
