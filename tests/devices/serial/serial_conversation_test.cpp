// Codec, checks and the host's side of the conversation, without a port.
#include "devices/serial/serial_conversation.h"

#include <doctest/doctest.h>

#include <random>

using namespace tangent;

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

ForceInfo some_info() {
  return {.serial = 3,
          .pushes_along = 7,
          .peak_mn = 4000,
          .workspace_um = {100000, 100000, 100000},
          .telemetry_hz = 1000,
          .watchdog_ms = 20};
}

/// A conversation and the frames it hears.
struct HostSide {
  SerialConversation talk;
  std::int64_t now_ns = kSecond_ns;
  std::uint16_t sequence = 0, heard = 0;
  std::uint32_t time_us = 0;

  HostSide() { talk.connected(now_ns); }
  void hear(const CldFrame& frame) {
    std::array<std::uint8_t, kCldLargestFrame> bytes{};
    talk.receive({bytes.data(), encode_frame(frame, bytes)}, now_ns);
  }
  void hear(ForceTelemetry t) {
    now_ns += 1'000'000;
    t.time_us = time_us += 1000;
    t.heard_sequence = heard;
    hear(to_frame(t, sequence++));
  }
  /// Commands that went out.
  std::vector<ForceCommandMessage> say(const ForceCommandMessage* command) {
    std::array<std::uint8_t, SerialConversation::kLargestTurn> out{};
    const std::size_t bytes = talk.compose(command, now_ns, out);
    std::vector<ForceCommandMessage> said;
    CldParser parser;
    parser.feed({out.data(), bytes}, [&](const CldFrame& f) {
      heard = f.sequence;
      if (const auto m = to_force_command(f)) said.push_back(*m);
    });
    return said;
  }
  void inform(const ForceInfo& info = some_info()) {
    say(nullptr);
    hear(to_frame(info, sequence++));
  }
};

const ForceCommandMessage kPush{{1000000, 2000000, -3000000}, SerialRequest::none};

}  // namespace

TEST_CASE("the bytes of a force command are those on the protocol's page") {
  std::array<std::uint8_t, kCldLargestFrame> bytes{};
  const std::size_t size = encode_frame(to_frame(ForceCommandMessage{{0, 0, -1500000}, {}}, 0x1234), bytes);
  const std::array<std::uint8_t, 19> wanted{0xC5, 0x01, 0x11, 0x0D, 0x34, 0x12, 0x00, 0x00, 0x00, 0x00,
                                            0x00, 0x00, 0x00, 0x00, 0xA0, 0x1C, 0xE9, 0xFF, 0x00};
  REQUIRE(size == wanted.size() + kCldCrcBytes);
  CHECK(std::equal(wanted.begin(), wanted.end(), bytes.begin()));
}

TEST_CASE("every force message survives the wire, and damaged ones give none") {
  std::mt19937 random(5);
  const auto any = [&random] { return static_cast<std::uint32_t>(random()); };
  for (int i = 0; i < 500; ++i) {
    const ForceInfo info{.version = static_cast<std::uint8_t>(any()),
                         .firmware_version = static_cast<std::uint16_t>(any()),
                         .serial = any(),
                         .pushes_along = static_cast<std::uint8_t>(any()),
                         .buttons = 3,
                         .peak_mn = static_cast<std::uint16_t>(any()),
                         .step_nm = any(),
                         .stiffness_n_per_m = any(),
                         .workspace_um = {any(), any(), any()},
                         .telemetry_hz = static_cast<std::uint16_t>(any()),
                         .homing_ms = static_cast<std::uint16_t>(any())};
    CHECK(to_force_info(to_frame(info, 1)) == info);
    const ForceTelemetry t{.time_us = any(),
                           .position_nm = {static_cast<std::int32_t>(any()), static_cast<std::int32_t>(any()), -1},
                           .force_mn = {-32768, 32767, static_cast<std::int16_t>(any())},
                           .orientation = {32767, -32767, 0, static_cast<std::int16_t>(any())},
                           .buttons = any(),
                           .state = static_cast<CldDeviceState>(any() % 4),
                           .fault = static_cast<CldDeviceFault>(any() % 6),
                           .heard_sequence = static_cast<std::uint16_t>(any()),
                           .missed_frames = static_cast<std::uint16_t>(any())};
    const auto read = to_force_telemetry(to_frame(t, 2));
    REQUIRE(read);
    CHECK(to_frame(*read, 2) == to_frame(t, 2));
    CHECK(read->position_nm == t.position_nm);
  }
  CldFrame shorter = to_frame(ForceTelemetry{}, 1);
  --shorter.length;
  CHECK_FALSE(to_force_telemetry(shorter));
  CldFrame odd = to_frame(ForceTelemetry{.state = static_cast<CldDeviceState>(4)}, 1);
  CHECK_FALSE(to_force_telemetry(odd));
  CHECK_FALSE(to_force_command(to_frame(ForceCommandMessage{{}, static_cast<SerialRequest>(4)}, 1)));
  CHECK_FALSE(to_force_hello(to_frame(ForceHello{3, 2}, 1)));
  CHECK_FALSE(to_force_info(to_frame(ForceTelemetry{}, 1)));
}

TEST_CASE("a conversation asks until it is told, and sends no command before") {
  HostSide h;
  CHECK(h.talk.has_to_speak(h.now_ns));
  CHECK(h.say(&kPush).empty());
  CHECK_FALSE(h.talk.has_to_speak(h.now_ns));
  h.now_ns += kSecond_ns / 10;
  CHECK(h.talk.has_to_speak(h.now_ns));
  h.inform();
  CHECK(h.talk.news().informed);
  CHECK_FALSE(h.talk.has_to_speak(h.now_ns + 10 * kSecond_ns));
  REQUIRE(h.say(&kPush).size() == 1);
  HostSide alone;
  alone.say(nullptr);
  alone.now_ns += 4 * kSecond_ns;
  alone.say(nullptr);
  CHECK(alone.talk.news().trouble == SerialTrouble::no_answer);
  alone.inform();  // a board that took its time
  CHECK(alone.talk.news().informed);
  CHECK(alone.talk.news().trouble == SerialTrouble::none);
}

TEST_CASE("a connection that is closed twice is closed") {
  HostSide h;
  CHECK(h.talk.news().connection % 2 == 1);
  h.talk.closed();
  const std::uint32_t closed = h.talk.news().connection;
  CHECK(closed % 2 == 0);
  h.talk.closed();
  CHECK(h.talk.news().connection == closed);
}

TEST_CASE("after trouble a conversation sends a stop at once, and no force until it is cleared") {
  HostSide h;
  h.inform();
  h.hear(ForceTelemetry{.state = CldDeviceState::ready});
  CHECK(h.say(&kPush).front().force_un == kPush.force_un);
  h.hear(ForceTelemetry{.position_nm = {300000000, 0, 0}, .state = CldDeviceState::ready});
  CHECK(h.talk.news().trouble == SerialTrouble::outside);
  CHECK(h.talk.has_to_speak(h.now_ns));
  const auto stop = h.say(nullptr);
  REQUIRE(stop.size() == 1);
  CHECK(stop.front().request == SerialRequest::stop);
  CHECK(h.say(&kPush).front().force_un == std::array<std::int32_t, 3>{});
  h.hear(ForceTelemetry{.state = CldDeviceState::ready});
  CHECK(h.talk.news().trouble == SerialTrouble::outside);
  const ForceCommandMessage clear{{}, SerialRequest::clear_fault};
  CHECK(h.say(&clear).front().request == SerialRequest::none);  // the firmware itself has nothing to clear
  h.hear(ForceTelemetry{.state = CldDeviceState::idle});
  CHECK(h.talk.news().trouble == SerialTrouble::none);
  CHECK(h.talk.news().state == CldDeviceState::idle);
}

TEST_CASE("a sample that waited on its way is as old as it is, also where the clocks differ by 300 ppm") {
  SampleClock clock;
  const auto arrival_ns = [](std::uint32_t time_us) {
    return kSecond_ns + std::int64_t{time_us} * 1000 * 10003 / 10000;
  };
  std::uint32_t time_us = 0xffffff00u;  // wraps on the way
  std::uint32_t since_us = 0;
  for (int i = 0; i < 20000; ++i, time_us += 1000, since_us += 1000) {
    const std::int64_t held_ns = i % 100 == 50 ? 7'000'000 : i % 10 == 3 ? 500'000 : 0;
    const std::int64_t arrived_ns = arrival_ns(since_us) + held_ns;
    REQUIRE(clock.add(time_us, arrived_ns) == SerialTrouble::none);
    CHECK(std::abs(arrived_ns - clock.measured_ns() - held_ns) <= 20'000);
  }
  CHECK(clock.add(time_us - 1000, arrival_ns(since_us)) == SerialTrouble::time_stood);
  CHECK(clock.add(time_us - 2000, arrival_ns(since_us)) == SerialTrouble::time_backwards);
  CHECK(clock.add(time_us + 100000, arrival_ns(since_us)) == SerialTrouble::time_ahead);
}

TEST_CASE("a board whose clock is slow by more than 500 ppm is told so before its samples seem too old") {
  struct {
    std::int64_t ppm;
    int most_s;  // until it is found; 0: never
  } const boards[] = {{-20000, 0}, {400, 0}, {600, 12}, {1000, 4}, {10000, 2}};
  for (const auto& board : boards) {
    CAPTURE(board.ppm);
    SampleClock clock;
    int found_at = 0;
    for (int i = 0; i < 20000 && found_at == 0; ++i) {
      const std::int64_t device_ns = std::int64_t{i} * 1'000'000;
      const std::int64_t arrived_ns = kSecond_ns + device_ns + device_ns / 1'000'000 * board.ppm + i % 7 * 10'000;
      if (clock.add(static_cast<std::uint32_t>(i) * 1000, arrived_ns) == SerialTrouble::time_slow) found_at = i;
    }
    CHECK(found_at <= board.most_s * 1000);
    CHECK((found_at > 0) == (board.most_s > 0));
  }
  CHECK(std::string(to_string(SerialTrouble::time_slow)).find("500 ppm") != std::string::npos);
}

TEST_CASE("whatever comes, a conversation believes positions within twice the workspace alone") {
  std::mt19937 random(11);
  HostSide h;
  h.inform();
  for (int i = 0; i < 10000; ++i) {
    const auto any = [&random](std::int32_t most) {
      return static_cast<std::int32_t>(random() % (2u * static_cast<unsigned>(most))) - most;
    };
    ForceTelemetry t{.position_nm = {any(90000000), any(90000000), any(90000000)},
                     .state = static_cast<CldDeviceState>(random() % 5)};
    if (random() % 50 == 0) t.position_nm[random() % 3] = static_cast<std::int32_t>(random());
    if (random() % 50 == 0) h.time_us = static_cast<std::uint32_t>(random());
    if (random() % 10 == 0) h.say(&kPush);
    std::array<std::uint8_t, kCldLargestFrame> noise{};
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    if (random() % 20 == 0) h.talk.receive({noise.data(), random() % noise.size()}, h.now_ns);
    h.hear(t);
    const SerialNews& news = h.talk.news();
    for (int axis = 0; axis < 3; ++axis) REQUIRE(std::abs(news.sample.position_m[axis]) <= 0.2);
    if (news.trouble != SerialTrouble::none) {
      for (const ForceCommandMessage& said : h.say(&kPush)) REQUIRE(said.force_un == std::array<std::int32_t, 3>{});
      const ForceCommandMessage clear{{}, SerialRequest::clear_fault};
      h.say(&clear);
    }
  }
  CHECK(h.talk.counts().crc_errors + h.talk.counts().skipped_bytes > 0);
}
