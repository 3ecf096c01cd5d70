#include "workbench/session/exchange_watch.h"

namespace tangent {

const char* to_string(ExchangeWith device) {
  switch (device) {
    case ExchangeWith::none:
      return "none";
    case ExchangeWith::force_device:
      return "force device";
    case ExchangeWith::display:
      return "contact display";
  }
  return "?";
}

void ExchangeWatch::begin(ExchangeWith device, std::int64_t now_ns) noexcept {
  began_.store(now_ns == 0 ? 0 : now_ns << kDeviceBits | static_cast<std::int64_t>(device), std::memory_order_release);
}

bool ExchangeWatch::end() noexcept {
  began_.store(0, std::memory_order_release);
  return found_.exchange(false, std::memory_order_acq_rel);
}

std::int64_t ExchangeWatch::lasts_ns(std::int64_t now_ns) const noexcept {
  const std::int64_t began = began_.load(std::memory_order_acquire);
  return began == 0 ? 0 : now_ns - (began >> kDeviceBits);
}

bool ExchangeWatch::look(std::int64_t now_ns) noexcept {
  const std::int64_t began = began_.load(std::memory_order_acquire);
  if (began == 0 || now_ns - (began >> kDeviceBits) <= kLongest_ns || found_.load(std::memory_order_relaxed))
    return false;
  const auto with = static_cast<ExchangeWith>(began & ((1 << kDeviceBits) - 1));
  bool stopped = false;
  if (with == ExchangeWith::force_device && devices_.force) stopped = devices_.force->emergency_stop();
  if (with == ExchangeWith::display && devices_.display) stopped = devices_.display->emergency_stop();
  stopped_.store(stopped, std::memory_order_relaxed);
  hung_.store(with, std::memory_order_release);
  found_.store(true, std::memory_order_release);
  return true;
}

}  // namespace tangent
