// The reference firmware by itself: its states, its limits, its watchdog, and what garbage does to it.
#include "devices/serial/firmware/hapkit_example.h"
#include "devices/serial/firmware/tangent_firmware.h"
#include "devices/serial/serial_messages.h"
#include "tests/devices/serial/serial_rig.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::serial_test;

namespace {

/// A firmware, what it pushes with, and what it said.
struct FirmwareBoard {
  tangent_firmware firmware{};
  std::array<float, 3> pushed{9.0f, 9.0f, 9.0f};
  std::vector<CldFrame> said;
  CldParser parser;
  tangent_reading reading{};
  int measures = 1, homed = 1;
  std::uint32_t now_us = 0;
  std::uint16_t sequence = 0;

  explicit FirmwareBoard(const tangent_description& is = three_axes()) {
    reading.orientation[0] = 1.0f;
    const tangent_board board{this, measure, push, home, send};
    tangent_init(&firmware, &board, &is);
  }
  static FirmwareBoard& of(void* context) { return *static_cast<FirmwareBoard*>(context); }
  static int measure(void* context, tangent_reading* out) {
    *out = of(context).reading;
    return of(context).measures;
  }
  static void push(void* context, const float* force) { std::copy_n(force, 3, of(context).pushed.begin()); }
  static int home(void* context) { return of(context).homed; }
  static void send(void* context, const std::uint8_t* bytes, std::size_t count) {
    FirmwareBoard& me = of(context);
    me.parser.feed({bytes, count}, [&me](const CldFrame& f) { me.said.push_back(f); });
  }

  void hear(const CldFrame& frame) {
    std::array<std::uint8_t, kCldLargestFrame> bytes{};
    tangent_receive(&firmware, bytes.data(), encode_frame(frame, bytes));
  }
  void command(const std::array<std::int32_t, 3>& force_un, SerialRequest request = SerialRequest::none) {
    hear(to_frame(ForceCommandMessage{force_un, request}, ++sequence));
  }
  void step(std::uint32_t us = 1000) { tangent_step(&firmware, now_us += us); }
  void make_ready() {
    command({}, SerialRequest::home);
    step();
    REQUIRE(firmware.state == TANGENT_READY);
  }
  std::optional<ForceTelemetry> telemetry() const {
    return said.empty() ? std::nullopt : to_force_telemetry(said.back());
  }
  std::optional<CldRefused> refused() const { return said.empty() ? std::nullopt : to_refused(said.back()); }
  bool pushes() const { return pushed != std::array<float, 3>{}; }
};

}  // namespace

TEST_CASE("the firmware's answer to a hello is what it was given, bit for bit") {
  FirmwareBoard b;
  b.hear(to_frame(ForceHello{}, 9));
  REQUIRE(b.said.size() == 1);
  const auto info = to_force_info(b.said.front());
  REQUIRE(info);
  CHECK(info->version == 1);
  CHECK(info->firmware_version == 0x0102);
  CHECK(info->serial == 77);
  CHECK(info->peak_mn == 5000);
  CHECK(info->step_nm == 10000);
  CHECK(info->damping_mn_s_per_m == 5000);
  CHECK(info->workspace_um == std::array<std::uint32_t, 3>{50000, 50000, 50000});
  CHECK(info->homing_ms == 1000);
  b.hear(to_frame(ForceHello{2, 3}, 10));  // a host that has forgotten version 1
  REQUIRE(b.refused());
  CHECK(b.refused()->reason == 1);
  b.hear(to_frame(ForceHello{1, 200}, 11));  // one that knows later ones
  CHECK(to_force_info(b.said.back()));
}

TEST_CASE("the firmware pushes in ready alone, no harder than its peak, along its axes") {
  FirmwareBoard b;
  CHECK_FALSE(b.pushes());
  b.command({1000000, 0, 0});
  b.step();
  CHECK_FALSE(b.pushes());
  b.make_ready();
  b.command({0, -2000000, 1500000});
  b.step();
  CHECK(b.pushed[1] == approx(-2.0));
  CHECK(b.pushed[2] == approx(1.5));
  CHECK(b.telemetry()->force_mn == std::array<std::int16_t, 3>{0, -2000, 1500});
  b.command({std::numeric_limits<std::int32_t>::min(), 4000000, std::numeric_limits<std::int32_t>::max()});
  b.step();
  const double length = std::sqrt(double{b.pushed[0]} * b.pushed[0] + double{b.pushed[1]} * b.pushed[1] +
                                  double{b.pushed[2]} * b.pushed[2]);
  CHECK(length == approx(5.0).epsilon(1e-4));
  b.command({0, 0, 1000000}, SerialRequest::stop);
  CHECK_FALSE(b.pushes());
  tangent_description is = three_axes();
  is.pushes_along = 2;
  FirmwareBoard one(is);
  one.make_ready();
  one.command({1000000, 1000000, 1000000});
  one.step();
  CHECK(one.pushed == std::array<float, 3>{0.0f, 1.0f, 0.0f});
}

TEST_CASE("the firmware's watchdog takes the force away 20 ms after the last command, also when its clock wraps") {
  for (const std::uint32_t start : {0u, 0xffffffffu - 12000u}) {
    FirmwareBoard b;
    b.now_us = start;
    b.make_ready();
    b.command({0, 0, 1000000});
    for (int i = 0; i < 21; ++i) {
      b.step();
      CHECK(b.pushes());
    }
    b.step();
    CHECK_FALSE(b.pushes());
    CHECK(b.telemetry()->state == CldDeviceState::faulted);
    CHECK(b.telemetry()->fault == CldDeviceFault::watchdog);
    b.command({0, 0, 1000000});
    b.step();
    CHECK_FALSE(b.pushes());  // latched
    b.command({}, SerialRequest::home);
    CHECK(b.refused()->reason == 5);
    b.command({}, SerialRequest::clear_fault);
    b.make_ready();
  }
}

TEST_CASE("the firmware stops when its sensor fails or gives no number, and says that it measured nothing") {
  for (const float bad : {NAN, INFINITY, -INFINITY, 1e30f, 3.0f}) {
    FirmwareBoard b;
    b.make_ready();
    b.command({0, 0, 1000000});
    b.reading.position_m[1] = bad;
    b.step();
    CHECK_FALSE(b.pushes());
    CHECK(b.telemetry()->fault == CldDeviceFault::encoder);
    CHECK(b.telemetry()->position_nm[1] == kNotMeasured);
  }
  FirmwareBoard silent;
  silent.make_ready();
  silent.measures = 0;
  silent.step();
  CHECK(silent.telemetry()->position_nm[0] == kNotMeasured);
}

TEST_CASE("homing of the firmware goes on until it is done, fails, or takes too long") {
  FirmwareBoard b;
  b.homed = 0;
  b.command({}, SerialRequest::home);
  for (int i = 0; i < 990; ++i) {
    b.step();
    REQUIRE(b.firmware.state == TANGENT_HOMING);
  }
  for (int i = 0; i < 20; ++i) b.step();
  CHECK(b.telemetry()->fault == CldDeviceFault::homing_failed);
  b.command({}, SerialRequest::clear_fault);
  b.homed = -1;
  b.command({}, SerialRequest::home);
  b.step();
  CHECK(b.telemetry()->fault == CldDeviceFault::homing_failed);
}

TEST_CASE("the firmware does not push with a force that came before, and counts what it missed") {
  FirmwareBoard b;
  b.make_ready();
  b.command({0, 0, 1000000});
  const std::uint16_t newest = b.sequence;
  b.hear(to_frame(ForceCommandMessage{{0, 0, 3000000}, SerialRequest::none}, static_cast<std::uint16_t>(newest - 1)));
  b.hear(to_frame(ForceCommandMessage{{0, 0, 3000000}, SerialRequest::none}, newest));
  b.step();
  CHECK(b.pushed[2] == approx(1.0));
  b.sequence = static_cast<std::uint16_t>(newest + 3);
  b.command({0, 0, 2000000});
  b.step();
  CHECK(b.pushed[2] == approx(2.0));
  CHECK(b.telemetry()->missed_frames == 3);
  CHECK(b.telemetry()->heard_sequence == b.sequence);
}

TEST_CASE("whatever comes over the line, the firmware pushes within its peak and in ready alone") {
  std::mt19937 random(3);
  constexpr int rounds = 10000;
  int pushing = 0;
  FirmwareBoard b;
  for (int i = 0; i < rounds; ++i) {
    const auto any = [&random] { return static_cast<std::int32_t>(random()); };
    CldFrame frame = to_frame(ForceCommandMessage{{any(), any(), any()}, static_cast<SerialRequest>(random() % 5)},
                              static_cast<std::uint16_t>(b.sequence + random() % 3));
    b.sequence = frame.sequence;
    if (random() % 8 == 0) frame.type = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) frame.version = static_cast<std::uint8_t>(random() % 3);
    std::array<std::uint8_t, kCldLargestFrame> bytes{};
    std::size_t count = encode_frame(frame, bytes);
    if (random() % 4 == 0) bytes[random() % count] = static_cast<std::uint8_t>(random());
    if (random() % 4 == 0) count = random() % count;
    tangent_receive(&b.firmware, bytes.data(), count);
    b.measures = random() % 64 != 0;
    b.step(static_cast<std::uint32_t>(random() % 3000));
    const double square =
        double{b.pushed[0]} * b.pushed[0] + double{b.pushed[1]} * b.pushed[1] + double{b.pushed[2]} * b.pushed[2];
    REQUIRE(square <= 5.001 * 5.001);
    REQUIRE((b.firmware.state == TANGENT_READY || square == 0.0));
    REQUIRE(b.firmware.held_bytes < TANGENT_LARGEST_FRAME);
    if (square > 0.0) ++pushing;
    if (b.said.size() > 1000) b.said.clear();
  }
  CHECK(pushing > rounds / 100);  // the rounds do get there
}

TEST_CASE("the firmware is short enough to read") {
  int lines = 0;
  for (const char* name : {"tangent_firmware.h", "tangent_firmware.c"}) {
    std::ifstream file(testing::source_folder() + "/devices/serial/firmware/" + name);
    REQUIRE(file);
    for (std::string line; std::getline(file, line);) ++lines;
  }
  CHECK(lines < 400);
}

// --- The example ---------------------------------------------------------------------------------------

namespace {

struct HapkitHardware {
  std::int32_t counts = 0;
  int answers = 1;
  float duty = 0.0f;
  std::vector<CldFrame> said;
  CldParser parser;
} hapkit_hardware;

}  // namespace

int hapkit_read_counts(std::int32_t* counts) {
  *counts = hapkit_hardware.counts;
  return hapkit_hardware.answers;
}
void hapkit_set_duty(float duty) { hapkit_hardware.duty = duty; }
void hapkit_send(const std::uint8_t* bytes, std::size_t count) {
  hapkit_hardware.parser.feed({bytes, count}, [](const CldFrame& f) { hapkit_hardware.said.push_back(f); });
}

TEST_CASE("the Hapkit of the example: its torque is what its motion says, and it moves along one axis") {
  hapkit_hardware = {};
  const hapkit_geometry g{.handle_m = 0.09f,
                          .sector_m = 0.075f,
                          .pulley_m = 0.005f,
                          .counts_per_turn = 4096.0f,
                          .torque_at_full_duty_nm = 0.03f};
  hapkit kit{};
  hapkit_init(&kit, &g, 5.0f, 42);
  // One turn of the motor is 2 pi 5 mm of cable, and 90 / 75 of that at the handle.
  CHECK(hapkit_position_m(&g, 4096) == approx(2.0 * 3.14159265 * 0.005 * 0.09 / 0.075));
  // Virtual work: force times motion is torque times angle.
  const double moved_m = static_cast<double>(hapkit_position_m(&g, 1000)), angle_rad = 2.0 * 3.14159265 * 1000 / 4096;
  CHECK(static_cast<double>(hapkit_torque_nm(&g, 2.0f)) * angle_rad == approx(2.0 * moved_m));
  CHECK(hapkit_duty(&g, 2.0f) == approx(2.0 * 0.006 / 0.03));
  CHECK(hapkit_duty(&g, 100.0f) == 1.0f);
  CHECK(hapkit_duty(&g, -100.0f) == -1.0f);
  CHECK(hapkit_duty(&g, NAN) == 0.0f);
  hapkit_geometry reversed = g;  // the motor mounted the other way round
  reversed.counts_per_turn = -g.counts_per_turn;
  hapkit other{};
  hapkit_init(&other, &reversed, 500.0f, 42);
  CHECK(other.firmware.is.step_nm == kit.firmware.is.step_nm);
  CHECK(other.firmware.is.peak_mn == 65000);
  hapkit_hardware.counts = 500;  // where it is homed
  const auto hear = [&kit](const CldFrame& frame) {
    std::array<std::uint8_t, kCldLargestFrame> bytes{};
    tangent_receive(&kit.firmware, bytes.data(), encode_frame(frame, bytes));
  };
  hear(to_frame(ForceHello{}, 0));
  const auto info = to_force_info(hapkit_hardware.said.back());
  REQUIRE(info);
  CHECK(info->pushes_along == 4);
  CHECK(info->workspace_um == std::array<std::uint32_t, 3>{0, 0, 40000});
  hear(to_frame(ForceCommandMessage{{}, SerialRequest::home}, 1));
  tangent_step(&kit.firmware, 1000);
  hapkit_hardware.counts = 1524;
  hear(to_frame(ForceCommandMessage{{1000000, 1000000, 2000000}, SerialRequest::none}, 2));
  tangent_step(&kit.firmware, 2000);
  const auto telemetry = to_force_telemetry(hapkit_hardware.said.back());
  REQUIRE(telemetry);
  CHECK(telemetry->position_nm[0] == 0);
  CHECK(telemetry->position_nm[2] == approx(1e9 * static_cast<double>(hapkit_position_m(&g, 1024))));
  CHECK(hapkit_hardware.duty == approx(0.4));
  hapkit_hardware.answers = 0;  // the encoder's cable
  tangent_step(&kit.firmware, 3000);
  CHECK(hapkit_hardware.duty == 0.0f);
}
