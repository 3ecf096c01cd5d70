// The Falcon's driver against an emulated Falcon behind the real libusb.
#include "devices/falcon/falcon_device.h"

#include "devices/base/sha256.h"
#include "tests/devices/usb/emulation/falcon_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/falcon_rig.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/temp_folder.h"

#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>

#include <dirent.h>

using namespace tangent;
using namespace tangent::emulation;

namespace {

/// The driver and its device. Time-outs are as good as none, so that nothing depends on the machine's load.
struct FalconBench {
  Testbed testbed;
  FalconModel model;
  PluggedDevice device;
  FalconDevice falcon;
  ForceSample sample;

  static FalconOptions patient(FalconOptions o = {}) {
    o.torque_counts_per_nm = 10'000.0;
    o.silence_s = o.line.answer_s = o.line.servo_gone_s = 100.0;
    o.line.question_s = 5.0;
    return o;
  }
  explicit FalconBench(const FalconOptions& options = patient(), NodeBy by = NodeBy::shim)
      : device(testbed, model, 4, by), falcon(options) {
    model.answers_at_once = true;
  }
  ~FalconBench() { falcon.close(); }
  void begin() {
    device.plug_in();
    device.run();
    REQUIRE(falcon.open());
  }
  const ForceSample& exchange(const Vec3& force = Vec3(0.0), DeviceRequest request = DeviceRequest::none) {
    return sample = falcon.exchange({.force_n = force, .request = request}, 1e-3);
  }
  bool reach(DeviceState state) {
    return eventually([&] { return exchange().state == state; });
  }
  void make_ready() { REQUIRE(reach(DeviceState::ready)); }
  bool is_pushed() {
    return device.board.with_model([&] { return model.pushes(); });
  }
  LinkReport report() {
    LinkReport r;
    REQUIRE(falcon.report(r));
    return r;
  }
};

/// Processor time of this process's thread of that name, s.
double thread_s(const std::string& name) {
  double seconds = 0.0;
  DIR* tasks = ::opendir("/proc/self/task");
  while (const dirent* entry = tasks != nullptr ? ::readdir(tasks) : nullptr) {
    const std::string folder = std::string("/proc/self/task/") + entry->d_name;
    std::string found;
    double ns = 0.0;
    if (std::ifstream(folder + "/comm") >> found && found == name && std::ifstream(folder + "/schedstat") >> ns)
      seconds += 1e-9 * ns;
  }
  if (tasks != nullptr) ::closedir(tasks);
  return seconds;
}

double clock_s(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

TEST_CASE("Falcon on USB: found, homed, followed and pushed, by bulk transfers") {
  FalconBench b;
  b.begin();
  b.make_ready();
  CHECK(b.report().identity == "firmware runs, 3 of 3 legs homed");
  b.device.board.with_model([&] { b.model.hand_m = kFalconCentre_m + Vec3(0.0, 0.02, 0.0); });
  CHECK(eventually([&] { return std::abs(b.exchange().position_m.y - 0.02) < 1e-3; }));
  CHECK(eventually([&] {
    b.exchange({0.0, 0.0, 2.0});
    return b.device.board.with_model([&] { return b.model.hand_n_per_m * (b.model.place_m().z - b.model.hand_m.z); }) >
           1.9;
  }));
  CHECK(b.device.board.with_model([&] { return b.model.pushed_unhomed; }) == 0);
  CHECK(b.device.board.with_model([&] { return b.model.bad_commands; }) == 0);
}

TEST_CASE(
    "Falcon on USB: its firmware is loaded from the owner's file, and refused where it is not the confirmed one") {
  const Bytes firmware = falcon_firmware_of(1300);
  const testing::TempFolder folder;
  FalconOptions options = FalconBench::patient();
  options.firmware = folder.write("f.bin", std::string(firmware.begin(), firmware.end()));
  {
    FalconDevice refused(options);
    const Status status = refused.open();
    REQUIRE_FALSE(status);
    CHECK(status.error().remedy.find("--falcon-firmware-sha256") != std::string::npos);
  }
  options.firmware_sha256 = sha256_text(firmware);
  options.line.question_s = 0.02;  // it is asked three times before
  FalconBench b(options);
  b.model.running = false;
  b.model.firmware = firmware;
  b.model.leading_zero = true;
  b.begin();
  b.make_ready();
  CHECK(b.device.board.with_model([&] { return b.model.uploads; }) == 1);
}

TEST_CASE("Falcon on USB: without firmware it says what to give") {
  FalconOptions options = FalconBench::patient();
  options.line.question_s = 0.02;
  FalconBench b(options);
  b.model.running = false;
  b.begin();
  REQUIRE(b.reach(DeviceState::faulted));
  CHECK(b.sample.fault == DeviceFault::firmware);
  CHECK(b.report().problem.find("--falcon-firmware") != std::string::npos);
}

TEST_CASE("Falcon on USB: of two, none is taken unless it is named by its serial number") {
  Testbed testbed;
  FalconModel first, second;
  first.answers_at_once = second.answers_at_once = true;
  first.serial = "LEFT";
  second.serial = "RIGHT";
  PluggedDevice left(testbed, first, 4), right(testbed, second, 5);
  left.plug_in();
  right.plug_in();
  left.run();
  right.run();
  FalconDevice any(FalconBench::patient());
  const Status refused = any.open();
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what.find("LEFT, RIGHT") != std::string::npos);
  CHECK(refused.error().remedy.find("--falcon-serial") != std::string::npos);
  FalconOptions options = FalconBench::patient();
  options.serial = "RIGHT";
  FalconDevice named(options);
  REQUIRE(named.open());
  CHECK(eventually([&] { return named.exchange({}, 1e-3).state == DeviceState::firmware; }));
  CHECK(right.board.with_model([&] { return second.commands; }) > 0);
  CHECK(left.board.with_model([&] { return first.commands; }) == 0);
  named.close();
  options.serial = "NOBODY";
  FalconDevice absent(options);
  REQUIRE(absent.open());  // it may be plugged in later
  LinkReport r;
  CHECK(eventually([&] {
    absent.report(r);
    return r.problem.find("Novint Falcon NOBODY") != std::string::npos;
  }));
  CHECK(r.problem.find("is not attached") != std::string::npos);
  absent.close();
}

TEST_CASE(
    "Falcon on USB: a second one plugged in before the first is opened is named as the problem, until it is gone") {
  Testbed testbed;
  FalconModel first, second;
  first.answers_at_once = second.answers_at_once = true;
  PluggedDevice left(testbed, first, 4), right(testbed, second, 5);
  FalconDevice falcon(FalconBench::patient());
  REQUIRE(falcon.open());
  left.plug_in(EACCES);  // so that it isn't taken before the second is there
  right.plug_in(EACCES);
  LinkReport r;
  CHECK(eventually([&] {
    falcon.report(r);
    return r.problem.find("is attached more than once") != std::string::npos;
  }));
  CHECK(falcon.exchange({}, 1e-3).state == DeviceState::absent);
  right.unplug();
  CHECK(eventually([&] {
    falcon.report(r);
    return r.problem.find("60-tangent-workbench.rules") != std::string::npos;
  }));
  left.unplug();
  left.plug_in();
  left.run();
  CHECK(eventually([&] { return falcon.exchange({}, 1e-3).state == DeviceState::firmware; }));
  falcon.close();
}

TEST_CASE("Falcon on USB: unplugged while it pushes it is absent, plugged in again it is homed, and goes on") {
  for (const NodeBy by : {NodeBy::shim, NodeBy::umockdev}) {
    FalconBench b(FalconBench::patient(), by);
    b.begin();
    for (int round = 0; round < 2; ++round) {
      b.make_ready();
      CHECK(eventually([&] {
        b.exchange({0.0, 0.0, 1.0});
        return b.is_pushed();
      }));
      b.device.unplug();
      REQUIRE(b.reach(DeviceState::absent));
      CHECK(b.sample.force_n == Vec3(0.0));
      CHECK(b.report().problem.find("not attached") != std::string::npos);
      b.device.plug_in();
      REQUIRE(b.reach(DeviceState::firmware));
    }
    CHECK(b.device.board.with_model([&] { return b.model.pushed_unhomed; }) == 0);
  }
}

TEST_CASE("Falcon on USB: stalls, bus errors and time-outs are survived") {
  // A lost answer has to be given up for the next command to go: here after 50 ms.
  FalconOptions options = FalconBench::patient();
  options.line.answer_s = 0.05;
  FalconBench b(options);
  b.begin();
  b.make_ready();
  for (const BusFault fault : {BusFault::stall, BusFault::error, BusFault::time_out}) {
    const std::uint64_t before = b.report().stalls + b.report().errors + b.report().time_outs;
    b.device.board.with_model([&] { b.model.next_out = fault; });
    CHECK(eventually([&] {
      b.exchange();
      return b.report().stalls + b.report().errors + b.report().time_outs > before;
    }));
  }
  b.device.board.with_model([&] { b.model.next_in = BusFault::stall; });
  const std::uint64_t answers = b.report().frames;
  CHECK(eventually([&] {
    b.exchange();
    return b.report().frames > answers + 10;
  }));
  CHECK(b.sample.state == DeviceState::ready);
}

TEST_CASE("Falcon on USB: an emergency stop needs no exchange, and closing leaves it without force and lamps") {
  FalconBench b;
  b.begin();
  b.make_ready();
  const auto push = [&] {
    return eventually([&] {
      b.exchange({0.0, 0.0, 1.0});
      return b.is_pushed();
    });
  };
  REQUIRE(push());
  CHECK(b.falcon.emergency_stop());
  CHECK(eventually([&] { return !b.is_pushed(); }));
  REQUIRE(b.reach(DeviceState::faulted));
  b.exchange(Vec3(0.0), DeviceRequest::clear_fault);
  b.make_ready();
  REQUIRE(push());
  b.falcon.close();
  CHECK_FALSE(b.is_pushed());
  CHECK(b.device.board.with_model([&] { return b.model.last.lamps; }) == 0);
  CHECK(b.exchange().state == DeviceState::absent);
  REQUIRE(b.falcon.open());
  CHECK(b.reach(DeviceState::firmware));
}

TEST_CASE("Falcon on USB: of 200 commands each is answered once") {
  FalconBench b;
  b.begin();
  b.make_ready();
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t answers = b.report().frames;
    b.exchange({0.0, 0.0, 0.5 + 0.001 * i});
    REQUIRE(eventually([&] { return b.report().frames > answers; }));
  }
  b.falcon.close();
  b.device.halt();
  const LinkReport r = b.report();
  CHECK(r.lost == 0);
  CHECK(r.skipped_bytes == 0);
  CHECK(r.refused_sends == 0);
  CHECK(b.model.commands >= r.frames);
  CHECK(b.model.commands <= r.frames + 2);  // the last ones, while it was closed
}

TEST_CASE("measure: 10,000 ticks through falcon" * doctest::skip()) {
  FalconOptions options;
  options.torque_counts_per_nm = 10'000.0;
  FalconBench b(options);
  b.model.answers_at_once = false;  // as the chip's latency of 1 ms has it
  b.begin();
  b.make_ready();
  constexpr int kTicks = 10'000;
  const std::uint64_t answers = b.report().frames, lost = b.report().lost;
  const double servo = clock_s(CLOCK_THREAD_CPUTIME_ID), link = thread_s("usb"), wall = clock_s(CLOCK_MONOTONIC);
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  int late = 0, not_ready = 0, old = 0;
  for (int i = 0; i < kTicks; ++i) {
    b.exchange({0.0, 0.0, std::sin(0.01 * i)});
    not_ready += b.sample.state != DeviceState::ready;
    old += b.sample.age_s > 3e-3;
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) {
      due.tv_nsec -= 1'000'000'000;
      ++due.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    late += static_cast<double>(now.tv_sec - due.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - due.tv_nsec) > 1e-3;
  }
  const double took = clock_s(CLOCK_MONOTONIC) - wall;
  MESSAGE("answers " << b.report().frames - answers << ", commands without an answer in 4 ms " << b.report().lost - lost
                     << ", samples older than 3 ms " << old << ", ticks not ready " << not_ready
                     << ", ticks late by 1 ms " << late << "; link's thread " << 100.0 * (thread_s("usb") - link) / took
                     << " % of a core, exchange and its clock "
                     << 100.0 * (clock_s(CLOCK_THREAD_CPUTIME_ID) - servo) / took << " %");
}
