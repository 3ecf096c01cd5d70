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
  with_.store(device, std::memory_order_relaxed);
  began_ns_.store(now_ns, std::memory_order_release);
}

bool ExchangeWatch::end() noexcept {
  began_ns_.store(0, std::memory_order_release);
  return found_.exchange(false, std::memory_order_acq_rel);
}

bool ExchangeWatch::look(std::int64_t now_ns) noexcept {
  const std::int64_t began = began_ns_.load(std::memory_order_acquire);
  if (began == 0 || now_ns - began <= kLongest_ns || found_.load(std::memory_order_relaxed)) return false;
  const ExchangeWith with = with_.load(std::memory_order_relaxed);
  bool stopped = false;
  if (with == ExchangeWith::force_device && devices_.force) stopped = devices_.force->emergency_stop();
  if (with == ExchangeWith::display && devices_.display) stopped = devices_.display->emergency_stop();
  stopped_.store(stopped, std::memory_order_relaxed);
  hung_.store(with, std::memory_order_release);
  found_.store(true, std::memory_order_release);
  return true;
}

}  // namespace tangent
