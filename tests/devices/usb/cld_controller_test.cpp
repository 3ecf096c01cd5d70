// The CLD driver against an emulated controller behind the real libusb.
#include "devices/cld/cld_controller.h"

#include "tests/devices/usb/emulation/cld_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/approx.h"

#include <cmath>
#include <ctime>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::emulation;

namespace {

constexpr double kDt = 1e-3;

/// The driver and its device, exchanged by hand.
struct Bench {
  Testbed testbed;
  CldModel model;
  PluggedDevice device;
  CldController cld;
  DisplaySample sample;
  std::vector<std::int32_t> sent;  ///< nm, all targets

  // Watchdog and silence time-outs only in the tests about them, so that the others do not depend on the machine's
  // load.
  struct Setting {
    NodeBy by = NodeBy::shim;
    bool watchdog = false;
    double silence_s = 10.0;
    bool has_firmware = true;
    std::uint16_t telemetry_hz = 1000;
  };
  static CldControllerOptions options(double silence_s) {
    CldControllerOptions o;
    o.silence_s = silence_s;
    return o;
  }
  Bench() : Bench(Setting()) {}
  explicit Bench(const Setting& setting) : device(testbed, model, 4, setting.by), cld(options(setting.silence_s)) {
    model.watchdog_on = setting.watchdog;
    model.has_firmware = setting.has_firmware;
    model.telemetry_hz = setting.telemetry_hz;
    device.plug_in();
    device.run();
    REQUIRE(cld.open());
  }
  ~Bench() { cld.close(); }

  const DisplaySample& exchange(double target = 0.0, DeviceRequest request = DeviceRequest::none) {
    sample = cld.exchange({.target_m = target, .request = request}, kDt);
    if (sample.state == DeviceState::ready) sent.push_back(static_cast<std::int32_t>(std::lround(target * 1e9)));
    return sample;
  }
  bool reach(DeviceState state, double target = 0.0) {
    return eventually([&] { return exchange(target).state == state; });
  }
  void make_ready() {
    REQUIRE(reach(DeviceState::firmware));
    exchange(0.0, DeviceRequest::home);
    REQUIRE(reach(DeviceState::ready));
  }
  LinkReport report() {
    LinkReport r;
    REQUIRE(cld.report(r));
    return r;
  }
};

void sleep_until_next_tick(timespec& due) {
  due.tv_nsec += 1'000'000;
  if (due.tv_nsec >= 1'000'000'000) {
    due.tv_nsec -= 1'000'000'000;
    ++due.tv_sec;
  }
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
}

double processor_s() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

TEST_CASE("the CLD controller is found, asked what it is, homed and followed") {
  Bench b;
  CHECK(b.cld.exchange({}, kDt).state != DeviceState::ready);
  REQUIRE(b.reach(DeviceState::firmware));
  CHECK(b.sample.travel_m == approx(20e-3));
  CHECK(b.report().travel_m == approx(20e-3));
  CHECK(b.report().resolution_m == approx(0.8e-6));
  CHECK(b.report().bandwidth_hz == approx(12.0));
  CHECK(b.report().firmware_timeout_s == approx(0.05));
  CHECK(b.report().identity == "firmware 1.2, serial 77");
  b.make_ready();
  CHECK(eventually([&] { return std::abs(b.exchange(4e-3).position_m - 4e-3) < 5e-6; }));
  CHECK(b.sample.state == DeviceState::ready);
  b.exchange(0.0, DeviceRequest::stop);
  CHECK(b.reach(DeviceState::firmware));  // knows its firmware, has to be homed again
}

TEST_CASE("gains and limits reach the controller when they change, and one that is plugged in anew") {
  Bench b;
  b.make_ready();
  const auto gains = [&] { return b.device.board.with_model([&] { return b.model.mechanism().gains(); }); };
  const CldGains own = gains();
  ControllerSettings wanted{.p_per_s2 = 2500.0,
                            .i_per_s3 = 12000.0,
                            .d_per_s = 70.25,
                            .target_weight = 0.75,
                            .lowest_m = -3e-3,
                            .highest_m = 4e-3,
                            .fastest_m_per_s = 0.2,
                            .largest_current_a = 0.25};
  b.cld.set_controller(wanted);
  REQUIRE(eventually([&] {
    b.exchange();
    return gains().p_per_s2 == 2500.0;
  }));
  CHECK(gains().i_per_s3 == 12000.0);
  CHECK(gains().d_per_s == approx(70.25));
  CHECK(gains().target_weight == approx(0.75).epsilon(1e-4));
  // The firmware clamps targets beyond the limit.
  CHECK(eventually([&] { return std::abs(b.exchange(9e-3).position_m - 4e-3) < 5e-6; }));
  b.device.unplug();
  REQUIRE(b.reach(DeviceState::absent));
  b.device.board.with_model([&] {
    b.model.forget_settings();
    return 0;
  });
  b.device.plug_in();
  REQUIRE(b.reach(DeviceState::firmware));
  CHECK(eventually([&] {
    b.exchange();
    return gains().p_per_s2 == 2500.0;
  }));
  b.cld.set_controller({});
  CHECK(eventually([&] {
    b.exchange();
    return gains().p_per_s2 == own.p_per_s2;
  }));
  CHECK(b.report().refused == 0);
}

TEST_CASE("10,000 ticks at 1 kHz: none lost, none doubled, either way") {
  Bench b;
  b.make_ready();
  constexpr int kTicks = 10'000;
  const double processor_before = processor_s();
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  const timespec began = due;
  for (int i = 0; i < kTicks; ++i) {
    const double target = 5e-3 * std::sin(0.002 * i);
    REQUIRE(b.exchange(target).state == DeviceState::ready);
    sleep_until_next_tick(due);
  }
  timespec ended{};
  clock_gettime(CLOCK_MONOTONIC, &ended);
  const double wall =
      static_cast<double>(ended.tv_sec - began.tv_sec) + 1e-9 * static_cast<double>(ended.tv_nsec - began.tv_nsec);
  const double processor = processor_s() - processor_before;
  REQUIRE(
      eventually([&] { return b.device.board.with_model([&] { return b.model.targets.size(); }) >= b.sent.size(); }));
  CHECK(b.sent.size() >= kTicks);
  b.device.halt();
  CHECK((b.model.targets == b.sent));
  for (const auto& [sequence, times] : b.model.heard) CHECK(times == 1);
  REQUIRE(eventually([&] { return b.report().frames >= b.model.telemetry_sent; }));
  const LinkReport r = b.report();
  CHECK(r.lost == 0);
  CHECK(r.doubled == 0);
  CHECK(r.late == 0);
  CHECK(r.lost_by_device == 0);
  CHECK(r.crc_errors == 0);
  CHECK(r.dropped_commands == 0);
  CHECK(r.refused_sends == 0);
  MESSAGE("10,000 ticks: processor " << 100.0 * processor / wall
                                     << " % of a core (both ends, emulation included), round trip p50 "
                                     << r.round_trip_us->percentile(0.5) << " us, p99 "
                                     << r.round_trip_us->percentile(0.99) << " us");
}

TEST_CASE(
    "split, merged, doubled and disordered packets, garbage and wrong checks cost what they hold and nothing else") {
  struct Case {
    WireFault fault;
    std::uint64_t crc_errors, lost, doubled, late;
  };
  for (const Case c :
       {Case{WireFault::split, 0, 0, 0, 0}, Case{WireFault::merged, 0, 0, 0, 0}, Case{WireFault::empty, 0, 0, 0, 0},
        Case{WireFault::garbage, 1, 0, 0, 0}, Case{WireFault::doubled, 0, 0, 1, 0},
        Case{WireFault::out_of_order, 0, 0, 0, 1}, Case{WireFault::crc_error, 1, 1, 0, 0}}) {
    CAPTURE(static_cast<int>(c.fault));
    Bench b;
    b.make_ready();
    constexpr int kTimes = 20;
    for (int i = 0; i < kTimes; ++i) {
      const auto sent = b.device.board.with_model([&] {
        b.model.next_wire = c.fault;
        return b.model.telemetry_sent;
      });
      REQUIRE(eventually([&] {
        b.exchange(1e-3);
        return b.device.board.with_model([&] { return b.model.telemetry_sent; }) > sent + 3;
      }));
    }
    CHECK(b.sample.state == DeviceState::ready);
    b.device.halt();
    REQUIRE(eventually([&] {
      return b.report().lost == kTimes * c.lost && b.report().frames + b.report().crc_errors >= b.model.telemetry_sent;
    }));
    const LinkReport r = b.report();
    // Bytes of a rejected frame are searched again, and may look like a frame once more.
    CHECK(r.crc_errors >= kTimes * c.crc_errors);
    CHECK((r.crc_errors > 0) == (c.crc_errors > 0));
    CHECK(r.lost == kTimes * c.lost);
    CHECK(r.doubled == kTimes * c.doubled);
    CHECK(r.late == kTimes * c.late);
    // A frame cut in two makes one; garbage may look like the start of a frame.
    if (c.fault == WireFault::split) CHECK(r.short_packets == kTimes);
    if (c.fault == WireFault::merged || c.fault == WireFault::empty || c.fault == WireFault::doubled)
      CHECK(r.short_packets == 0);
    if (c.fault == WireFault::empty) CHECK(r.empty_packets == kTimes);
  }
}

TEST_CASE("stalls, bus errors and time-outs are counted and survived") {
  Bench b;
  b.make_ready();
  for (const BusFault fault : {BusFault::stall, BusFault::error}) {
    b.device.board.with_model([&] { b.model.next_in = fault; });
    CHECK(eventually([&] {
      b.exchange(1e-3);
      return (fault == BusFault::stall ? b.report().stalls : b.report().errors) >= 1;
    }));
    b.device.board.with_model([&] { b.model.next_out = fault; });
    CHECK(eventually([&] {
      b.exchange(1e-3);
      return (fault == BusFault::stall ? b.report().stalls : b.report().errors) >= 2;
    }));
  }
  b.device.board.with_model([&] { b.model.next_out = BusFault::time_out; });
  CHECK(eventually([&] {
    b.exchange(1e-3);
    return b.report().time_outs >= 1;
  }));
  CHECK(eventually([&] { return std::abs(b.exchange(2e-3).position_m - 2e-3) < 5e-6; }));
  CHECK(b.sample.state == DeviceState::ready);
  CHECK(b.report().lost_by_device >= 1);
}

TEST_CASE(
    "unplugged in the middle of transfers the display is absent - plugged in again it has to be homed, and goes on") {
  Bench b;
  for (int round = 0; round < 5; ++round) {
    b.make_ready();
    for (int i = 0; i < 50; ++i) b.exchange(1e-3);
    b.device.unplug();
    REQUIRE(b.reach(DeviceState::absent));
    CHECK_FALSE(b.report().connected);
    CHECK(b.report().problem.find("not attached") != std::string::npos);
    b.device.plug_in();
    REQUIRE(b.reach(DeviceState::firmware));  // not ready by itself
    for (int i = 0; i < 20; ++i) CHECK(b.exchange(3e-3).state == DeviceState::firmware);
  }
  b.make_ready();
  CHECK(eventually([&] { return std::abs(b.exchange(3e-3).position_m - 3e-3) < 5e-6; }));
  CHECK(b.report().connects == 6);
}

TEST_CASE("an emergency stop reaches the controller without an exchange, before what is queued") {
  Bench b;
  b.make_ready();
  b.exchange(3e-3);
  CHECK(b.cld.emergency_stop());
  CHECK(eventually([&] { return b.device.board.with_model([&] { return b.model.state(); }) == CldDeviceState::idle; }));
  CHECK(b.reach(DeviceState::firmware));
}

TEST_CASE("without targets the firmware's watchdog stops the drive, and the host says so") {
  Bench b({.watchdog = true});
  b.make_ready();
  REQUIRE(eventually(
      [&] { return b.device.board.with_model([&] { return b.model.state() == CldDeviceState::faulted; }); }));
  CHECK(b.device.board.with_model([&] { return b.model.watchdog_fired; }) == 1);
  REQUIRE(b.reach(DeviceState::faulted));
  CHECK(b.sample.fault == DeviceFault::watchdog);
  b.exchange(0.0, DeviceRequest::clear_fault);
  b.make_ready();
}

TEST_CASE("a frozen encoder is found by the firmware") {
  Bench b;
  b.make_ready();
  b.device.board.with_model([&] { b.model.encoder_stuck = true; });
  REQUIRE(b.reach(DeviceState::faulted, 5e-3));
  CHECK(b.sample.fault == DeviceFault::sensor);
}

TEST_CASE("a device that falls silent is lost until a person clears it - its last sample grows old meanwhile") {
  Bench b({.silence_s = 0.1});
  b.make_ready();
  b.device.board.with_model([&] { b.model.telemetry_on = false; });
  REQUIRE(eventually([&] { return b.exchange().age_s > 0.01; }));
  REQUIRE(b.reach(DeviceState::faulted));
  CHECK(b.sample.fault == DeviceFault::disconnected);
  b.device.board.with_model([&] { b.model.telemetry_on = true; });
  for (int i = 0; i < 50; ++i) CHECK(b.exchange().state == DeviceState::faulted);
  b.exchange(0.0, DeviceRequest::clear_fault);
  REQUIRE(eventually([&] {
    return b.exchange().state != DeviceState::faulted || (b.exchange(0.0, DeviceRequest::clear_fault), false);
  }));
  b.make_ready();
}

TEST_CASE("a device without firmware, or with one that no host may accept, is never homed") {
  for (const bool silent : {true, false}) {
    Bench b({.has_firmware = !silent, .telemetry_hz = 0});
    REQUIRE(b.reach(DeviceState::faulted));
    CHECK(b.sample.fault == DeviceFault::firmware);
    CHECK(b.report().problem.find("firmware") != std::string::npos);
    b.exchange(0.0, DeviceRequest::home);
    CHECK(b.device.board.with_model([&] { return b.model.state() == CldDeviceState::idle; }));
  }
}

TEST_CASE("a device that may not be opened says which rule to install, and works once it may") {
  Testbed testbed;
  CldModel model;
  PluggedDevice device(testbed, model, 5);
  device.plug_in(EACCES);
  device.run();
  CldController cld;
  REQUIRE(cld.open());
  LinkReport r;
  REQUIRE(eventually([&] {
    cld.report(r);
    return r.problem.find("60-tangent-workbench.rules") != std::string::npos;
  }));
  CHECK(cld.exchange({}, kDt).state == DeviceState::absent);
  device.unplug();
  device.plug_in();
  CHECK(eventually([&] { return cld.exchange({}, kDt).state == DeviceState::firmware; }));
}

TEST_CASE("through umockdev's own device node: found, homed, followed, unplugged in the middle, and back") {
  Bench b({.by = NodeBy::umockdev});
  for (int round = 0; round < 2; ++round) {
    b.make_ready();
    const double target = round == 0 ? 2e-3 : -2e-3;
    CHECK(eventually([&] { return std::abs(b.exchange(target).position_m - target) < 5e-6; }));
    CHECK(b.report().crc_errors == 0);
    CHECK(b.report().doubled == 0);
    b.device.unplug();
    REQUIRE(b.reach(DeviceState::absent));
    b.device.plug_in();
    REQUIRE(b.reach(DeviceState::firmware));
  }
}
