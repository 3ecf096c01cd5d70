#include "devices/falcon/falcon_codec.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

using namespace tangent;

namespace {

FalconPacket packet_of(std::string_view text) {
  REQUIRE(text.size() == kFalconPacketBytes);
  FalconPacket packet{};
  std::copy(text.begin(), text.end(), packet.begin());
  return packet;
}

std::string text_of(const FalconPacket& packet) { return {packet.begin(), packet.end()}; }

}  // namespace

TEST_CASE("Falcon packets are, byte for byte, as published") {
  CHECK(text_of(to_packet(FalconCommand{})) == "<AAAAAAAAAAAAAA>");
  // 1447 is 0x05A7: the lowest nibble first.
  CHECK(text_of(to_packet(FalconCommand{{1447, -1, 0x1234}, true, kFalconRed})) == "<HKFAPPPPEDCBJA>");
  const auto answer = to_answer(packet_of("<HKFAPPPPAAAIrA>"));  // 'r' - 'A' = 0x31
  REQUIRE(answer);
  CHECK(answer->encoder == std::array<std::int16_t, 3>{1447, -1, -32768});
  CHECK(answer->buttons == 1);
  CHECK(answer->homed == 3);
  CHECK_FALSE(answer->all_homed());
}

TEST_CASE("every number of 16 bits and every flag of a Falcon packet comes back") {
  for (int value = -32768; value <= 32767; value += 7) {
    const auto v = static_cast<std::int16_t>(value);
    const FalconAnswer sent{{v, static_cast<std::int16_t>(~v), 0},
                            static_cast<std::uint8_t>(value & 15),
                            static_cast<std::uint8_t>((value >> 4) & 7)};
    const auto got = to_answer(to_packet(sent));
    REQUIRE(got);
    CHECK(got->encoder == sent.encoder);
    CHECK(got->buttons == sent.buttons);
    CHECK(got->homed == sent.homed);
    const auto command = to_command(to_packet(FalconCommand{{v, 0, v}, (value & 1) != 0, kFalconGreen}));
    REQUIRE(command);
    CHECK(command->torque == std::array<std::int16_t, 3>{v, 0, v});
    CHECK(command->homing == ((value & 1) != 0));
    CHECK(command->lamps == kFalconGreen);
  }
}

TEST_CASE("a byte that can't occur in a Falcon packet makes it none") {
  const FalconPacket good = to_packet(FalconAnswer{{1, 2, 3}, 0, 7});
  REQUIRE(to_answer(good));
  for (std::size_t at = 0; at < good.size(); ++at) {
    if (at == 14) continue;  // not used
    FalconPacket bad = good;
    bad[at] = 0x20;
    CHECK_FALSE(to_answer(bad));
    bad[at] = 0xff;
    CHECK_FALSE(to_answer(bad));
  }
}

TEST_CASE("Falcon packets are found in a stream however it is cut, and what is between them is counted") {
  std::string stream = "xx";
  for (const auto v : std::array<std::int16_t, 3>{5, -6, 700})
    stream += text_of(to_packet(FalconAnswer{{v, v, v}, 0, 0}));
  stream += "<AAAA";                                                   // the rest was lost
  stream += text_of(to_packet(FalconAnswer{{9, 9, 9}, 0, 0})) + "..";  // 2 + 5 + 2 bytes of no packet
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    FalconParser parser;
    std::vector<int> found;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      const auto bytes = std::string_view(stream).substr(at, piece);
      parser.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                  [&](const FalconPacket& p) { found.push_back(to_answer(p)->encoder[0]); });
    }
    CHECK(found == std::vector<int>{5, -6, 700, 9});
    CHECK(parser.skipped() == 9);
  }
}

TEST_CASE("the two status bytes of the FTDI chip are no data, and packets of them alone hold none") {
  const std::vector<std::uint8_t> three{0x01, 0x60, 0x41}, two{0x01, 0x60}, one{0x01};
  CHECK(ftdi_payload(three).size() == 1);
  CHECK(ftdi_payload(three).front() == 0x41);
  CHECK(ftdi_payload(two).empty());
  CHECK(ftdi_payload(one).empty());
  CHECK(ftdi_payload({}).empty());
}
