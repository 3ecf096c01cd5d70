#include "devices/haply/haply_codec.h"

#include "devices/haply/haply_address.h"
#include "devices/haply/haply_link.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace tangent;
using namespace tangent::test;

namespace {

// In the form of the published examples of 3.1 (docs.haply.co/inverseSDK/service/api/simulation), with values of ours.
const std::string kHaplyList = R"({"inverse3":[{"device_id":"04BA","config":{"type":"inverse3","device_info":
  {"major_version":7},"handedness":"right"},"state":{"body_orientation":{"x":0,"y":0.7,"z":0,"w":0.7},
  "cursor_position":{"x":0.078,"y":-0.148,"z":0.142},"cursor_velocity":{"x":-0.01,"y":0.002,"z":-0.04},"mode":"idle"},
  "status":{"calibrated":true,"in_use":false,"power_supply":true,"ready":true,"started":true}}],
  "verse_grip":[{"device_id":"61548","state":{"button":true,"hall":0,"orientation":{"x":0,"y":0,"z":0,"w":1}}}]})";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a Haply list of devices is read: position in metres, velocity, status, buttons") {
  if (!haply_built_in()) return;
  HaplyMessage message;
  REQUIRE(read_haply(kHaplyList, {}, message));
  CHECK_FALSE(message.has_session);
  CHECK(message.grip.buttons == 1u);
  REQUIRE(message.devices.size() == 1);
  const HaplyEntry& device = message.devices.front();
  CHECK(device.id == "04BA");
  CHECK(device.position_m == Vec3(0.078, -0.148, 0.142));
  CHECK(device.has_velocity);
  CHECK(device.velocity_m_per_s == Vec3(-0.01, 0.002, -0.04));
  CHECK(device.status.usable());
  CHECK(device.status.calibrated);
  CHECK(device.own_axes);
  CHECK(device.problem == HaplyProblem::none);
}

TEST_CASE("how a Haply VerseGrip is turned is read where it is a rotation and there is one grip") {
  if (!haply_built_in()) return;
  HaplyMessage message;
  const auto read = [&](const char* turn) {
    REQUIRE(read_haply(changed(kHaplyList, R"({"x":0,"y":0,"z":0,"w":1})", turn), {}, message));
    return message.grip;
  };
  // The published example of a list.
  const HaplyGrip grip = read(R"({"x":-0.5019531,"y":0.8632202,"z":-0.048095703,"w":-0.022338867})");
  CHECK(grip.turned);
  CHECK(glm::length(grip.orientation) == approx(1.0).epsilon(1e-12));
  CHECK(grip.orientation.y == approx(0.8632202).epsilon(1e-4));
  for (const char* bad : {R"({"x":0,"y":0,"z":0,"w":0})", R"({"x":0,"y":0,"z":0,"w":1.1})", R"({"x":0,"y":0,"z":0})",
                          R"({"x":null,"y":0,"z":0,"w":1})", "7"}) {
    CAPTURE(bad);
    CHECK_FALSE(read(bad).turned);
    CHECK(message.grip.lies);
    CHECK(message.devices.front().problem == HaplyProblem::none);
  }
  REQUIRE(read_haply(R"({"verse_grip":[{"state":{"button":true}},{"state":{"button":true}}]})", {}, message));
  CHECK(message.grips == 2);
  CHECK(message.grip.buttons == 0u);
}

TEST_CASE("an event of a Haply service is read, and what it says is shown as plain text") {
  if (!haply_built_in()) return;
  HaplyEvent event;
  REQUIRE(read_haply_event(R"({"name":"device-safety-triggered","category":"device","level":"error",
    "data":{"device_family":"inverse","device_id":"049D","safety_type":"ebrake_triggered"},"message":"E-brake\u001b[2J"})",
                           event));
  CHECK(event.level == HaplyEvent::Level::error);
  CHECK(event.device == "049D");
  CHECK(event.text == "device-safety-triggered: E-brake?[2J");
  REQUIRE(read_haply_event(R"({"name":")" + std::string(1000, 'n') + R"(","level":"info","data":{}})", event));
  CHECK(event.text.size() == 200);
  CHECK(event.device.empty());
  for (const char* bad : {"", "[]", "{}", R"({"name":"a"})", R"({"level":"error"})", R"({"name":"a","level":"loud"})",
                          R"({"name":7,"level":"error"})"}) {
    CAPTURE(bad);
    CHECK_FALSE(read_haply_event(bad, event));
  }
}

TEST_CASE("what a Haply message leaves out stays as the message before said") {
  if (!haply_built_in()) return;
  HaplyMessage first, next;
  REQUIRE(
      read_haply(changed(kHaplyList, "\"handedness\":\"right\"", "\"basis\":{\"permutation\":\"XZY\"}"), {}, first));
  CHECK_FALSE(first.devices.front().own_axes);
  const std::string update = R"({"inverse3":[{"device_id":"04BA","state":{"cursor_position":{"x":0,"y":0,"z":0.1}}}]})";
  REQUIRE(read_haply(update, first.devices, next));
  CHECK(next.devices.front().status.usable());
  CHECK_FALSE(next.devices.front().own_axes);
  CHECK_FALSE(next.devices.front().has_velocity);
  REQUIRE(read_haply(update, {}, next));
  CHECK_FALSE(next.devices.front().status.usable());
  CHECK(read_haply("{}", first.devices, next));
  CHECK(next.devices.empty());
}

TEST_CASE("a Haply message that lies is refused, or the one device that it lies about") {
  if (!haply_built_in()) return;
  HaplyMessage message;
  for (const char* bad : {"", "x", "[]", "7", "{\"inverse3\":7}", "{\"inverse3\":[7]}", "{\"inverse3\":[{}]}",
                          "{\"inverse3\":[{\"device_id\":\"a\\\"b\"}]}", "{\"verse_grip\":{}}", "{\"a\":\"\xff\"}"}) {
    CAPTURE(bad);
    CHECK_FALSE(read_haply(bad, {}, message));
  }
  CHECK_FALSE(read_haply(std::string(100, '[') + std::string(100, ']'), {}, message));
  CHECK_FALSE(read_haply(std::string(kHaplyLargestMessage + 1, ' '), {}, message));
  const auto problem = [&](const char* from, const char* to) {
    REQUIRE(read_haply(changed(kHaplyList, from, to), {}, message));
    return message.devices.front().problem;
  };
  CHECK(problem("0.142", "null") == HaplyProblem::not_understood);
  CHECK(problem("0.142", "\"0.142\"") == HaplyProblem::not_understood);
  CHECK(problem("\"z\":0.142", "\"w\":0.142") == HaplyProblem::not_understood);
  CHECK(problem("0.142", "0.7") == HaplyProblem::position);
  CHECK(problem("-0.04", "-40") == HaplyProblem::position);
  CHECK(problem("\"calibrated\":true", "\"calibrated\":1") == HaplyProblem::not_understood);
  CHECK(problem("\"mode\":\"idle\"", "\"transform\":{\"scale\":{\"x\":1,\"y\":1,\"z\":1}}") == HaplyProblem::none);
  CHECK(message.devices.front().own_axes);
  problem("\"mode\":\"idle\"", "\"transform\":{\"scale\":{\"x\":2,\"y\":1,\"z\":1}}");
  CHECK_FALSE(message.devices.front().own_axes);
}

TEST_CASE("a Haply message with more devices than anybody has is refused") {
  if (!haply_built_in()) return;
  const auto with = [](std::size_t devices) {
    std::string text = R"({"inverse3":[)";
    for (std::size_t i = 0; i < devices; ++i) text += (i == 0 ? "" : ",") + std::string(R"({"device_id":"A"})");
    HaplyMessage message;
    return read_haply(text + "]}", {}, message);
  };
  CHECK(with(kHaplyMostDevices));
  CHECK_FALSE(with(kHaplyMostDevices + 1));
}

TEST_CASE("whatever bytes of a Haply message are changed, what is taken from it is finite and in reach") {
  if (!haply_built_in()) return;
  std::mt19937 random(1);
  HaplyMessage message;
  int understood = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = kHaplyList;
    for (auto n = 1 + random() % 3; n > 0; --n) text[random() % text.size()] = static_cast<char>(random());
    if (random() % 8 == 0) text.resize(random() % text.size());
    if (!read_haply(text, {}, message)) continue;
    ++understood;
    for (const HaplyEntry& device : message.devices) {
      CHECK(is_haply_id(device.id));
      if (device.problem == HaplyProblem::none) CHECK(glm::length(device.position_m) <= kHaplyFarthest_m);
    }
  }
  CHECK(understood > 100);
}

TEST_CASE("a Haply force is written in newtons, with the key of its version") {
  if (!haply_built_in()) return;
  std::string text;
  write_haply_force(text, "049D", Vec3(0.0, -0.25, 1.5), true);
  CHECK(text == R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":)"
                R"({"x":0.000000,"y":-0.250000,"z":1.500000}}}}]})");
  write_haply_force(text, "049D", Vec3(0.0), false);
  CHECK(text.find("\"values\":{\"x\":0.000000,") != std::string::npos);
}

TEST_CASE("an address of an Inverse Service is this machine's, unless another is allowed") {
  const auto read = [](const char* text, bool other) { return read_haply_address(text, other); };
  CHECK(read("ws://localhost:10001", false)->port == "10001");
  CHECK(read("ws://localhost/", false)->port == "10001");
  CHECK(read("ws://127.0.0.1:7", false)->host == "127.0.0.1");
  CHECK(read("ws://[::1]:7", false)->host == "::1");
  for (const char* other : {"ws://192.168.1.5:10001", "ws://localhost.example.org", "ws://127.0.0.1.example.org"}) {
    CAPTURE(other);
    REQUIRE_FALSE(read(other, false));
    CHECK(read(other, false).error().remedy.find("--haply-other-host") != std::string::npos);
    CHECK(read(other, true));
  }
  for (const char* bad :
       {"", "localhost:10001", "http://localhost", "wss://localhost", "ws://", "ws://localhost:", "ws://localhost:0",
        "ws://localhost:70000", "ws://localhost:1x", "ws://[::1", "ws://a b", "ws://localhost:1:2", "ws://[::1]x"}) {
    CAPTURE(bad);
    CHECK_FALSE(read(bad, true));
  }
}
