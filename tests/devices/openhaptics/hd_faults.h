// What can go wrong with a device behind OpenHaptics, injected into the stub.
#pragma once

#include "tests/devices/openhaptics/hd_stub_loader.h"

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace tangent::test {

struct HdFault {
  const char* name;
  void (*begin)(HdLoop& l);
  int most_ticks = 2;
  bool stays_put = false;  ///< readings freeze
};

inline const std::vector<HdFault>& hd_faults() {
  static const std::vector<HdFault> faults{
      {"unplugged", [](HdLoop& l) { l.hd.unplugged = true; }},
      {"motors too warm", [](HdLoop& l) { l.hd.frame_error = 0x0200; }},
      {"force limit exceeded", [](HdLoop& l) { l.hd.frame_error = 0x0201; }},
      {"fault of the device's own", [](HdLoop& l) { l.hd.frame_error = 0x0300; }},
      {"unknown error code", [](HdLoop& l) { l.hd.frame_error = 0x0abc; }},
      {"position not a number", [](HdLoop& l) { l.hd.position_mm[1] = std::numeric_limits<double>::quiet_NaN(); }},
      {"velocity infinite", [](HdLoop& l) { l.hd.velocity_mm_per_s[0] = std::numeric_limits<double>::infinity(); }},
      {"garbage in the transform", [](HdLoop& l) { l.hd.transform[5] = 1e300; }},
      {"position outside its reach", [](HdLoop& l) { l.hd.position_mm[0] = 5000.0; }},
      {"position jumps by 50 mm", [](HdLoop& l) { l.hd.position_mm[0] += 50.0; }},
      {"stall of 30 ms", [](HdLoop& l) { l.loop.take(0.03); }},
      {"readings freeze in motion", [](HdLoop&) {}, 22, true},
  };
  return faults;
}

inline TicksTo measure_hd_fault(const HdFault& fault) {
  HdOptions options = stub_hd_options();
  options.reopen_s = 1e6;
  HdLoop l(options);
  return ticks_of_fault(l, fault, [&](int t) { l.hd.position_mm[2] = 10.0 * std::sin(0.03 * t); });
}

}  // namespace tangent::test
