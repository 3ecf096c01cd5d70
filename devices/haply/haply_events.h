// What the Inverse Service reports by itself: its events come over a WebSocket of their own (port 10020), one way and
// seldom, and are heard in a thread of their own without real-time priority. Nothing is ever sent there.
#pragma once

#include "devices/haply/haply_codec.h"
#include "devices/haply/haply_link.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

namespace tangent {

class HaplyEvents final : private HaplyLinkHandler {
 public:
  HaplyEvents() : link_(*this) {}
  ~HaplyEvents() { stop(); }

  /// Listens for those about this device. Where nobody answers it is tried again; nothing depends on it.
  Status start(const HaplyLinkOptions& where, const std::string& device);
  void stop();

  // Any thread.
  /// Errors of the device, and worse of the service: as many, after one of which no force is sent.
  std::uint32_t alarms() const noexcept { return alarms_.load(std::memory_order_acquire); }
  bool heard() const noexcept { return open_.load(std::memory_order_relaxed); }
  /// The newest warning or error about the device; empty: none.
  std::string newest() const;

 private:
  void on_open() noexcept override { open_ = true; }
  void on_message(std::string_view text) noexcept override;
  bool next(std::string&) noexcept override { return false; }
  bool last(std::string&) noexcept override { return false; }
  void on_closed(HaplyProblem, const std::string&) noexcept override { open_ = false; }

  std::string device_;
  HaplyEvent event_;
  std::atomic<bool> open_{false};
  std::atomic<std::uint32_t> alarms_{0};
  mutable std::mutex mutex_;  ///< of newest_
  std::string newest_;
  HaplyLink link_;  ///< last: its thread uses all of them
};

}  // namespace tangent
