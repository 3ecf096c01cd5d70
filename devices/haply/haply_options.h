// How to reach a Haply Inverse3. A header of its own, cheap to include: options of the program carry it.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <string>

namespace tangent {

/// CLOCK_MONOTONIC in nanoseconds. Any thread.
std::int64_t haply_now_ns() noexcept;

struct HaplyOptions {
  std::string address = "ws://localhost:10001";  ///< of Haply's Inverse Service
  bool other_host = false;                       ///< whether it may be on another machine
  std::string device = {};                       ///< device_id, as "049D"; empty: the only one there is
  int events_port = 10020;  ///< of the same host, where the service reports events; 0: they are not heard
  /// No more is sent. Haply's pages state no peak force: this is a careful limit of ours.
  double peak_force_n = 3.0;
  /// Centre of the workspace in Haply's axes, from the base: where the cursor is in Haply's published example.
  Vec3 centre_m{0.0, -0.12, 0.15};
  bool realtime = true;        ///< the link's thread asks for SCHED_FIFO
  double connect_s = 1.0;      ///< for each step of connecting: the socket, the WebSocket, the list of devices
  double retry_s = 0.5;        ///< until it connects again
  double silence_s = 0.1;      ///< ticks' time without an answer: fault `disconnected`, and a new connection
  int quiet_ticks = 2;         ///< exchanges without an answer after which no force is asked for
  double our_stall_s = 10e-3;  ///< clock's time without an exchange after which the link's thread sends zero force
  std::int64_t (*clock)() noexcept = haply_now_ns;  ///< of a sample's age
};

}  // namespace tangent
