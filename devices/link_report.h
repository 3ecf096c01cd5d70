// State and counters of a USB device's link, for panels and the command line.
#pragma once

#include "devices/base/log_histogram.h"

#include <array>
#include <cstdint>
#include <string>

namespace tangent {

/// Each number is consistent by itself; together they are not a snapshot of one instant.
struct LinkReport {
  bool connected = false;
  std::string identity;  ///< "firmware 1.2, serial 77"; empty: not known
  std::string serial;    ///< of the device on the cable; empty: it says none, or its driver does not ask
  std::string problem;   ///< why it is not connected and what to do; empty: none
  double travel_m = 0.0, resolution_m = 0.0, bandwidth_hz = 0.0, rate_hz = 0.0,
         firmware_timeout_s = 0.0;  ///< as reported by the device; 0: not known
  std::uint64_t packets_in = 0, packets_out = 0, controls = 0;
  std::uint64_t short_packets = 0;  ///< in: ended inside a frame; out: not taken completely
  std::uint64_t empty_packets = 0, stalls = 0, time_outs = 0, errors = 0, refused_sends = 0, connects = 0;
  std::uint64_t frames = 0, crc_errors = 0, skipped_bytes = 0;
  std::uint64_t lost = 0, doubled = 0, late = 0;  ///< frames from the device, by sequence number
  std::uint64_t lost_by_device = 0;               ///< host frames that the device missed
  std::uint64_t refused = 0;                      ///< commands the device did not carry out
  std::uint64_t dropped_commands = 0;             ///< never sent: no transfer was free
  std::array<std::uint8_t, 64> last_packet{};     ///< raw, newest
  std::size_t last_packet_bytes = 0;
  const LogHistogram* round_trip_us = nullptr;  ///< lives as long as the device; null: not measured
  const LogHistogram* arrival_us = nullptr;     ///< between telemetry frames
};

}  // namespace tangent
