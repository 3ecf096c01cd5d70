#include "devices/cld/cld_messages.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string_view>
#include <vector>

using namespace tangent;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const CldFrame& frame) {
  Bytes bytes(kCldLargestFrame);
  bytes.resize(encode_frame(frame, bytes));
  return bytes;
}

CldFrame random_frame(std::mt19937& random, std::uint16_t sequence) {
  CldFrame frame{.type = static_cast<std::uint8_t>(random()),
                 .sequence = sequence,
                 .length = static_cast<std::uint8_t>(random() % (kCldLargestPayload + 1))};
  for (std::size_t i = 0; i < frame.length; ++i)
    frame.payload[i] = static_cast<std::uint8_t>(random() % 4 == 0 ? kCldSync : random());
  return frame;
}

std::vector<CldFrame> parsed(CldParser& parser, const Bytes& bytes) {
  std::vector<CldFrame> frames;
  parser.feed(bytes, [&](const CldFrame& f) { frames.push_back(f); });
  return frames;
}

}  // namespace

TEST_CASE("the frame check is CRC-16/CCITT-FALSE") {
  constexpr std::string_view digits = "123456789";
  CHECK(cld_crc({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}) == 0x29B1);
}

TEST_CASE("the bytes of a target are those on the protocol's page") {
  const Bytes bytes = encoded(to_frame(CldTarget{.target_nm = -1'500'000}, 0x1234));
  const Bytes wanted{0xC5, 0x01, 0x02, 0x04, 0x34, 0x12, 0xA0, 0x1C, 0xE9, 0xFF};
  REQUIRE(bytes.size() == 12);
  CHECK(std::equal(wanted.begin(), wanted.end(), bytes.begin()));
  CHECK(bytes[10] == (cld_crc({bytes.data() + 1, 9}) & 0xff));
  CHECK(bytes[11] == cld_crc({bytes.data() + 1, 9}) >> 8);
}

TEST_CASE("every message survives the wire, at its extremes and at random") {
  std::mt19937 random(1);
  const auto any32 = [&random] { return static_cast<std::uint32_t>(random()); };
  const auto any16 = [&random] { return static_cast<std::uint16_t>(random()); };
  for (int i = 0; i < 2000; ++i) {
    const std::uint16_t sequence = any16();
    const CldTelemetry t{.time_us = any32(),
                         .position_nm = static_cast<std::int32_t>(any32()),
                         .target_nm = INT32_MIN,
                         .current_ma = static_cast<std::int16_t>(any16()),
                         .state = static_cast<CldDeviceState>(random() % 4),
                         .fault = static_cast<CldDeviceFault>(random() % 6),
                         .heard_sequence = any16(),
                         .missed_frames = any16()};
    CldParser parser;
    const auto frames = parsed(parser, encoded(to_frame(t, sequence)));
    REQUIRE(frames.size() == 1);
    CHECK(frames[0].sequence == sequence);
    const auto back = to_telemetry(frames[0]);
    REQUIRE(back);
    CHECK(back->time_us == t.time_us);
    CHECK(back->position_nm == t.position_nm);
    CHECK(back->target_nm == INT32_MIN);
    CHECK(back->current_ma == t.current_ma);
    CHECK(back->state == t.state);
    CHECK(back->fault == t.fault);
    CHECK(back->heard_sequence == t.heard_sequence);
    CHECK(back->missed_frames == t.missed_frames);
    CHECK_FALSE(to_info(frames[0]));
  }
  const auto info = to_info(to_frame(CldInfo{0x0102, 77, 20'000'000, 800'000, 1200, 1000, 50}, 9));
  REQUIRE(info);
  CHECK(info->firmware_version == 0x0102);
  CHECK(info->serial == 77);
  CHECK(info->travel_nm == 20'000'000);
  CHECK(info->step_pm == 800'000);
  CHECK(info->bandwidth_centihz == 1200);
  CHECK(info->telemetry_hz == 1000);
  CHECK(info->watchdog_ms == 50);
  const auto gains = to_gains(to_frame(CldWireGains{4'000'000'000u, 1, -2, 3}, 9));
  REQUIRE(gains);
  CHECK(gains->p_per_s2 == 4'000'000'000u);
  CHECK(gains->i_per_s3 == 1);
  CHECK(gains->d_milli_per_s == -2);
  CHECK(gains->target_weight_per_65535 == 3);
  const auto limits = to_limits(to_frame(CldWireLimits{-5, 6, 7, 8}, 9));
  REQUIRE(limits);
  CHECK(limits->lowest_nm == -5);
  CHECK(limits->highest_nm == 6);
  CHECK(limits->fastest_um_per_s == 7);
  CHECK(limits->largest_current_ma == 8);
  const auto refused = to_refused(to_frame(CldRefused{2, 300, 4}, 9));
  REQUIRE(refused);
  CHECK(refused->type == 2);
  CHECK(refused->sequence == 300);
  CHECK(refused->reason == 4);
}

TEST_CASE("messages that can't be are refused") {
  CldFrame frame = to_frame(CldTarget{5}, 1);
  CHECK(to_target(frame));
  frame.version = 2;
  CHECK_FALSE(to_target(frame));
  frame = to_frame(CldTarget{5}, 1);
  frame.length = 3;
  CHECK_FALSE(to_target(frame));
  CHECK_FALSE(to_limits(to_frame(CldWireLimits{6, 5, 0, 0}, 1)));
  CldTelemetry t;
  t.state = static_cast<CldDeviceState>(9);
  CHECK_FALSE(to_telemetry(to_frame(t, 1)));
}

TEST_CASE("frames come out whole however the stream is cut") {
  std::mt19937 random(2);
  std::vector<CldFrame> sent;
  Bytes stream;
  for (int i = 0; i < 3000; ++i) {
    sent.push_back(random_frame(random, static_cast<std::uint16_t>(i)));
    const Bytes bytes = encoded(sent.back());
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  CldParser parser;
  std::vector<CldFrame> got;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t count = std::min(stream.size() - at, std::size_t{1} + random() % 130);
    parser.feed(std::span(stream).subspan(at, count), [&](const CldFrame& f) { got.push_back(f); });
    at += count;
  }
  CHECK(got == sent);
  CHECK(parser.counts().crc_errors == 0);
  CHECK(parser.counts().skipped_bytes == 0);
}

TEST_CASE("garbage between frames costs no frame but those it hides for a moment") {
  std::mt19937 random(3);
  CldParser parser;
  std::vector<CldFrame> sent, got;
  const auto feed = [&](const Bytes& bytes) { parser.feed(bytes, [&](const CldFrame& f) { got.push_back(f); }); };
  for (int i = 0; i < 2000; ++i) {
    Bytes rubbish(random() % 20);
    for (auto& byte : rubbish) byte = static_cast<std::uint8_t>(random());
    feed(rubbish);
    sent.push_back(random_frame(random, static_cast<std::uint16_t>(i)));
    feed(encoded(sent.back()));
  }
  feed(Bytes(kCldLargestFrame, 0));  // pushes out what rubbish has made wait
  CHECK(got == sent);
  CHECK(parser.counts().skipped_bytes > 0);
}

TEST_CASE("a flipped bit loses its frame and no other, and is counted") {
  std::mt19937 random(4);
  int crc_errors = 0;
  for (int i = 0; i < 3000; ++i) {
    const CldFrame first = random_frame(random, 1), second = random_frame(random, 2);
    Bytes bytes = encoded(first);
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1u << (random() % 8)));
    const Bytes more = encoded(second);
    bytes.insert(bytes.end(), more.begin(), more.end());
    bytes.resize(bytes.size() + kCldLargestFrame, 0);
    CldParser parser;
    const auto frames = parsed(parser, bytes);
    CHECK(std::find(frames.begin(), frames.end(), first) == frames.end());
    CHECK(std::find(frames.begin(), frames.end(), second) != frames.end());
    crc_errors += parser.counts().crc_errors > 0;
  }
  CHECK(crc_errors > 2000);
}

TEST_CASE("any bytes at all may be fed: no frame without a right check, no byte unaccounted for") {
  std::mt19937 random(5);
  CldParser parser;
  std::uint64_t in_frames = 0, fed = 0;
  for (int i = 0; i < 400'000; ++i) {
    const auto byte = static_cast<std::uint8_t>(random() % 8 == 0   ? kCldSync
                                                : random() % 8 == 1 ? random() % 50
                                                                    : random());
    ++fed;
    for (auto frame = parser.feed(byte); frame; frame = parser.next()) {
      in_frames += kCldHeaderBytes + frame->length + kCldCrcBytes;
      // Whatever came through, the messages either read or refuse it.
      static_cast<void>(to_target(*frame));
      static_cast<void>(to_telemetry(*frame));
      static_cast<void>(to_info(*frame));
    }
  }
  CHECK(parser.counts().skipped_bytes + in_frames <= fed);
  CHECK(fed - parser.counts().skipped_bytes - in_frames < kCldLargestFrame);
  CHECK(parser.counts().crc_errors > 0);
  CHECK(parser.counts().wrong_lengths > 0);
}

TEST_CASE("sequence numbers tell lost, doubled and late frames apart, also over the wrap") {
  for (const int start : {0, 65530}) {
    CldSequence sequence;
    const auto add = [&](int n) { return sequence.add(static_cast<std::uint16_t>(start + n)); };
    CHECK(add(0) == CldSequence::Arrival::in_order);
    CHECK(add(1) == CldSequence::Arrival::in_order);
    CHECK(add(1) == CldSequence::Arrival::doubled);
    CHECK(add(5) == CldSequence::Arrival::after_loss);
    CHECK(sequence.lost() == 3);
    CHECK(add(3) == CldSequence::Arrival::late);
    CHECK(add(3) == CldSequence::Arrival::doubled);
    CHECK(sequence.lost() == 2);
    for (int i = 6; i < 300; ++i) CHECK(add(i) == CldSequence::Arrival::in_order);
    CHECK(sequence.lost() == 2);
    CHECK(sequence.doubled() == 2);
    CHECK(sequence.late() == 1);
  }
}
