// Every fault of an Inverse Service, and after how many ticks driver and gate notice it and send no force.
#pragma once

#include "tests/devices/haply/haply_rig.h"

#include <string>
#include <vector>

namespace tangent::testing {

struct HaplyFault {
  enum class Sign : std::uint8_t { bad, gone, answer, asked };  ///< seen when: noted, closed, heard; or only: asked
  const char* name;
  Sign sign;
  void (*inject)(HaplyService& service);
};

struct HaplyFaultSeen {
  int to_notice = -1, to_zero = -1;  ///< ticks after the fault was there; -1: never within 20
  DeviceState state = DeviceState::absent;
  DeviceFault fault = DeviceFault::none;
  bool service_has_zero = true;  ///< where it still listens
};

inline void reply_with(HaplyService& service, HaplyReply reply) {
  service.set_policy([reply](std::uint64_t, const std::string&) { return reply; });
}
inline void reply_text(HaplyService& service, std::string text) {
  reply_with(service, {HaplyReply::How::send, std::move(text)});
}
/// What would be right, with `from` in it replaced.
inline void reply_changed(HaplyService& service, std::string from, std::string to) {
  service.set_policy([from, to](std::uint64_t, std::string right) {
    const std::size_t at = right.find(from);
    return HaplyReply{HaplyReply::How::send, at == std::string::npos ? right : right.replace(at, from.size(), to)};
  });
}

inline const std::vector<HaplyFault>& haply_faults() {
  using Sign = HaplyFault::Sign;
  using How = HaplyReply::How;
  static const std::vector<HaplyFault> faults = {
      {"unplugged (no longer listed)", Sign::answer, [](HaplyService& s) { s.set_options({.devices = {}}); }},
      {"another one in its place", Sign::answer, [](HaplyService& s) { s.set_options({.devices = {"04BA"}}); }},
      {"its power is cut", Sign::answer, [](HaplyService& s) { s.set_options({.power = false}); }},
      {"its calibration is lost", Sign::answer, [](HaplyService& s) { s.set_options({.calibrated = false}); }},
      {"the service closes", Sign::gone,
       [](HaplyService& s) {
         reply_with(s, {How::close, ""});
       }},
      {"the service dies (reset)", Sign::gone,
       [](HaplyService& s) {
         reply_with(s, {How::reset, ""});
       }},
      {"half a frame, and no more", Sign::asked,
       [](HaplyService& s) {
         reply_with(s, {How::half_frame, ""});
       }},
      {"silence", Sign::asked,
       [](HaplyService& s) {
         reply_with(s, {How::nothing, ""});
       }},
      {"answers held back", Sign::asked,
       [](HaplyService& s) {
         s.set_policy([](std::uint64_t, const std::string& right) { return HaplyReply{How::hold, right}; });
       }},
      {"garbage", Sign::bad, [](HaplyService& s) { reply_text(s, "\x01{]"); }},
      {"JSON that is no state", Sign::bad, [](HaplyService& s) { reply_text(s, "[1,2,3]"); }},
      {"NaN", Sign::bad, [](HaplyService& s) { reply_changed(s, "\"z\":0.15", "\"z\":NaN"); }},
      {"null for a number", Sign::bad, [](HaplyService& s) { reply_changed(s, "\"z\":0.15", "\"z\":null"); }},
      {"a word for a number", Sign::bad, [](HaplyService& s) { reply_changed(s, "\"z\":0.15", "\"z\":\"0.15\""); }},
      {"1e999", Sign::bad, [](HaplyService& s) { reply_changed(s, "\"z\":0.15", "\"z\":1e999"); }},
      {"no position", Sign::bad, [](HaplyService& s) { reply_changed(s, "cursor_position", "cursor_positron"); }},
      {"where no Inverse3 can be", Sign::bad, [](HaplyService& s) { s.put_finger(Vec3(0.0, 0.0, 40.0)); }},
      {"outside the workspace", Sign::answer, [](HaplyService& s) { s.put_finger(Vec3(0.0, -0.12, 0.27)); }},
      {"a leap of 90 mm", Sign::answer, [](HaplyService& s) { s.put_finger(Vec3(0.0, -0.12, 0.24)); }},
      {"other axes", Sign::bad, [](HaplyService& s) { reply_changed(s, "\"w\":1", "\"w\":0.5"); }},
      {"its VerseGrip is gone", Sign::bad, [](HaplyService& s) { s.set_options({.grip = std::nullopt}); }},
      {"its VerseGrip's turn is no rotation", Sign::bad,
       [](HaplyService& s) { s.set_options({.grip = Quat(0.0, 0.0, 0.0, 0.0)}); }},
      {"states that nobody asked for", Sign::bad,
       [](HaplyService& s) {
         s.set_policy([](std::uint64_t, const std::string& right) { return HaplyReply{How::flood, right}; });
       }},
      {"deep nesting", Sign::bad, [](HaplyService& s) { reply_text(s, std::string(100'000, '[')); }},
      {"a message of 10 MB", Sign::gone, [](HaplyService& s) { reply_text(s, std::string(10'000'000, ' ')); }},
  };
  return faults;
}

/// Injects it into a rig that pushes, in the answer to one more tick, and counts ticks from there.
inline HaplyFaultSeen measure_haply_fault(const HaplyFault& fault) {
  HaplyService service;
  HaplyRig rig(service);
  HaplyFaultSeen seen;
  if (!rig.push()) return seen;
  fault.inject(service);
  const LinkReport before = rig.report();
  const std::uint64_t received = service.received();
  rig.tick();
  const bool there = emulation::eventually(
      [&] {
        const LinkReport now = rig.report();
        switch (fault.sign) {
          case HaplyFault::Sign::bad:
            return now.errors > before.errors;
          case HaplyFault::Sign::gone:
            return now.connects > before.connects || !now.connected;
          case HaplyFault::Sign::answer:
            return now.packets_in > before.packets_in;
          case HaplyFault::Sign::asked:
            return service.received() > received;
        }
        return false;
      },
      60.0);
  if (!there) return seen;
  for (int tick = 1; tick <= 20; ++tick) {
    rig.tick();
    const bool noticed = rig.sample.state != DeviceState::ready || rig.gate.fault() != GateFault::none ||
                         rig.report().late > before.late || rig.out.force_n == Vec3(0.0);
    if (noticed && seen.to_notice < 0) {
      seen.to_notice = tick;
      seen.state = rig.sample.state;
      seen.fault = rig.sample.fault;
    }
    if (rig.sample.force_n != Vec3(0.0))
      seen.to_zero = -1;
    else if (seen.to_zero < 0)
      seen.to_zero = tick;
  }
  if (fault.sign != HaplyFault::Sign::gone)
    seen.service_has_zero = emulation::eventually([&] { return service.force_n() == Vec3(0.0); }, 60.0);
  return seen;
}

}  // namespace tangent::testing
