// The Falcon's driver against an emulated Falcon behind the real libusb.
#include "tests/devices/usb/falcon_bench.h"

#include "devices/base/sha256.h"
#include "tests/support/temp_folder.h"

#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

using namespace tangent;
using namespace tangent::emulation;

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

TEST_CASE(
    "Falcon on USB: one that is plugged in later is used with the scale and the firmware kept for its serial number") {
  const Bytes firmware = falcon_firmware_of(1300);
  const testing::TempFolder folder;
  FalconOptions options = FalconBench::patient();
  options.torque_counts_per_nm = 0.0;
  options.line.question_s = 0.02;
  options.kept["F00001"] = {.torque_counts_per_nm = 20'000.0,
                            .firmware = folder.write("f.bin", std::string(firmware.begin(), firmware.end())),
                            .firmware_sha256 = sha256_text(firmware)};
  options.kept["OTHER"] = {900.0, folder.file("moved.bin"), ""};
  FalconBench b(options);
  b.model.running = false;
  b.model.firmware = firmware;
  b.model.counts_per_nm = 20'000.0;
  REQUIRE(b.falcon.open());
  CHECK(b.exchange().state == DeviceState::absent);
  b.device.run();
  b.device.plug_in();
  b.make_ready();
  CHECK(b.report().serial == "F00001");
  CHECK(b.report().identity == "firmware runs, 3 of 3 legs homed");
  CHECK(eventually([&] {
    b.exchange({0.0, 0.0, 2.0});
    return b.device.board.with_model([&] { return b.model.hand_n_per_m * (b.model.place_m().z - b.model.hand_m.z); }) >
           1.9;
  }));
  b.device.unplug();
  REQUIRE(b.reach(DeviceState::absent));
  b.model.serial = "OTHER";  // its firmware is not where it was
  b.model.running = false;
  b.device.plug_in();
  REQUIRE(b.reach(DeviceState::faulted));
  CHECK(b.sample.fault == DeviceFault::firmware);
  CHECK(b.report().serial == "OTHER");
}

TEST_CASE("Falcon on USB: told to stop by another thread while it is closed, it writes to no other's file") {
  FalconBench b;
  b.device.plug_in();
  b.device.run();
  for (int round = 0; round < 3; ++round) {
    REQUIRE(b.falcon.open());
    std::atomic<bool> going{true};
    std::atomic<int> calls{0};
    std::thread other([&] {
      for (; going; ++calls) b.falcon.emergency_stop();
    });
    CHECK(eventually([&] { return calls > 10; }));
    b.falcon.close();
    // Descriptors that were closed are given out again: these have to stay empty.
    const testing::TempFolder folder;
    std::vector<int> files;
    for (int i = 0; i < 8; ++i)
      files.push_back(
          ::open(folder.file("f" + std::to_string(i)).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR));
    const int closed = calls;
    CHECK(eventually([&] { return calls > closed + 10; }));
    going = false;
    other.join();
    for (const int file : files) {
      CHECK(::lseek(file, 0, SEEK_END) == 0);
      ::close(file);
    }
  }
}

TEST_CASE("Falcon on USB: told to stop while it is being opened, it stays stopped until a person clears that") {
  FalconBench b;
  b.device.plug_in();
  b.device.run();
  std::atomic<int> stops{0};
  b.model.when_asked_for_serial = [&] {  // by open, before it has a driver for what is plugged in
    if (stops++ == 0) CHECK(b.falcon.emergency_stop());
  };
  REQUIRE(b.falcon.open());
  REQUIRE(stops > 0);
  REQUIRE(b.reach(DeviceState::faulted));
  CHECK(b.sample.fault == DeviceFault::watchdog);
  for (int i = 0; i < 20; ++i) CHECK(b.exchange({0.0, 0.0, 1.0}).state == DeviceState::faulted);
  CHECK_FALSE(b.is_pushed());
  b.exchange(Vec3(0.0), DeviceRequest::clear_fault);
  b.make_ready();
}

TEST_CASE("Falcon on USB: other threads may stop it and ask about it while it is opened") {
  FalconBench b;
  b.device.plug_in();
  b.device.run();
  std::atomic<bool> going{false}, opened{false};
  std::thread other;
  b.model.when_asked_for_serial = [&] {  // open is under way
    if (going.exchange(true)) return;
    other = std::thread([&] {
      LinkReport r;
      do {  // once at least: on a busy machine it may come to run only when all is open
        CHECK((b.falcon.emergency_stop() && b.falcon.report(r)));
        std::this_thread::sleep_for(std::chrono::microseconds(50));  // else it starves what opens, on one core
      } while (!opened);
    });
  };
  for (int round = 0; round < 3; ++round) {
    going = opened = false;
    REQUIRE(b.falcon.open());
    opened = true;
    REQUIRE(going);
    other.join();
    CHECK(b.reach(DeviceState::faulted));
    b.falcon.close();
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
    const std::uint64_t answered = b.report().frames;  // two in a row without an answer would be another thing
    CHECK(eventually([&] { return b.exchange(), b.report().frames > answered; }));
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
