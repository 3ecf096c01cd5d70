// What can go wrong with a device behind DHD, injected into the stub.
#pragma once

#include "tests/devices/dhd/dhd_stub_loader.h"

#include <cmath>
#include <limits>
#include <vector>

namespace tangent::test {

struct DhdFault {
  const char* name;
  void (*begin)(DhdLoop& l);
  int most_notice = 2, most_zero = 2;
  bool stays_put = false;  ///< readings freeze
};

inline const std::vector<DhdFault>& dhd_faults() {
  static const std::vector<DhdFault> faults{
      {"unplugged", [](DhdLoop& l) { l.dhd.unplugged = true; }},
      {"no answer in time", [](DhdLoop& l) { l.dhd.call_error = 7; }},
      {"unknown error code", [](DhdLoop& l) { l.dhd.call_error = 99; }},
      {"fault of the device's own", [](DhdLoop& l) { l.dhd.broken = true; }},
      {"its force button pressed",
       [](DhdLoop& l) {
         l.dhd.force_off_cause = 1;
         l.dhd.force_on = false;
       }},
      {"calibration lost", [](DhdLoop& l) { l.dhd.calibrated = false; }},
      {"position not a number", [](DhdLoop& l) { l.dhd.position_m[1] = std::numeric_limits<double>::quiet_NaN(); }},
      {"velocity infinite", [](DhdLoop& l) { l.dhd.velocity_m_per_s[0] = std::numeric_limits<double>::infinity(); }},
      {"garbage in the orientation", [](DhdLoop& l) { l.dhd.matrix[1][1] = 1e300; }},
      {"position outside its reach", [](DhdLoop& l) { l.dhd.position_m[0] = 0.5; }},
      {"position jumps by 50 mm", [](DhdLoop& l) { l.dhd.position_m[0] += 0.05; }},
      {"silence: the last answer again (DHD_TIMEGUARD)", [](DhdLoop& l) { l.dhd.position_returns = 1; }, 12, 2},
      {"stall of 30 ms", [](DhdLoop& l) { l.loop.take(0.03); }},
      {"readings freeze in motion", [](DhdLoop&) {}, 22, 22, true},
  };
  return faults;
}

inline TicksTo measure_dhd_fault(const DhdFault& fault) {
  DhdOptions options = stub_dhd_options();
  options.reopen_s = 1e6;
  DhdLoop l(options);
  l.dhd.wrist = true;
  return ticks_of_fault(l, fault, [&](int t) { l.dhd.position_m[2] = 0.01 * std::sin(0.03 * t); });
}

}  // namespace tangent::test
