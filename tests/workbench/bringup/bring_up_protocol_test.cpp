// Protocols of a bring-up, what is kept of them, and the runner.
#include "workbench/bringup/bring_up_protocol.h"

#include "devices/simulated/scheduled_force_device.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/bringup/simulated_person.h"
#include "workbench/bringup/bring_up_runner.h"
#include "workbench/bringup/bring_up_text.h"
#include "workbench/bringup/proved_devices.h"

#include <nlohmann/json.hpp>

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

using namespace tangent;
using namespace tangent::testing;
using tangent::test::approx;

namespace {

BringUpProtocol protocol_of(const Crookedness& faults) {
  CrookedDevice device(faults);
  BringUpProtocol p;
  p.result = bring_up(device, {.most_n = 0.2}).view;
  p.kind = "crooked";
  p.device = device.capabilities();
  p.date = "2026-11-23T16:00:00Z";
  p.program = "9.9";
  p.most_n = 0.2;
  return p;
}

bool has_text(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("bring-up's protocol: every step with its verdict, for programs and for people") {
  const BringUpProtocol p = protocol_of({});
  const auto json = nlohmann::json::parse(protocol_json(p));
  CHECK(json["all_proved"] == true);
  CHECK(json["steps"].size() == kBringUpSteps);
  CHECK(json["device"]["serial"] == "77");
  CHECK(json["measured"]["pushes"].size() == 9);  // 0.1, 0.2, -0.2 N along three axes
  CHECK(json["measured"]["motions"][1]["asked"] == "right");
  CHECK_FALSE(json["not_proved"].empty());
  const std::string page = protocol_page(p);
  CHECK(has_text(page, "| Axes and signs | proved |"));
  CHECK(has_text(page, "this proves nothing about a real one"));
}

TEST_CASE("bring-up's protocol: a failed step says why") {
  const BringUpProtocol p = protocol_of({.pushes = glm::dmat3(0.0)});
  const auto json = nlohmann::json::parse(protocol_json(p));
  CHECK(json["all_proved"] == false);
  CHECK(has_text(json["steps"][7]["why"], "nothing moved up to the limit"));
  CHECK(has_text(protocol_page(p), "| Stop | not reached |"));
}

TEST_CASE("bring-up's protocol: a device that could not be opened") {
  const Error why{"may not be opened by this user", "falcon", "install the udev rule"};
  const BringUpProtocol absent = unopened_protocol("falcon", {}, why, false);
  CHECK(absent.result.verdict(BringUpStep::cable) == StepVerdict::failed);
  const BringUpProtocol forbidden = unopened_protocol("falcon", {}, why, true);
  CHECK(forbidden.result.verdict(BringUpStep::cable) == StepVerdict::proved);
  CHECK(forbidden.result.verdict(BringUpStep::permission) == StepVerdict::failed);
  CHECK(has_text(protocol_page(forbidden), "install the udev rule"));
}

TEST_CASE("bring-up's protocol is written with the page beside it, and never over it") {
  const TempFolder folder;
  const BringUpProtocol p = protocol_of({});
  REQUIRE(write_protocol(p, folder.file("p.json")));
  CHECK(read_text(folder.file("p.json")) == protocol_json(p));
  CHECK(read_text(folder.file("p.md")) == protocol_page(p));
  CHECK_FALSE(write_protocol(p, folder.file("p.md")));
  CHECK_FALSE(write_protocol(p, folder.file("missing/p.json")));
}

TEST_CASE("what was proved is kept by driver and serial number") {
  const TempFolder folder;
  const std::filesystem::path file = folder.file("config/proved-devices.toml");
  const ProvedDevice good = proved_device(protocol_of({}));
  CHECK(good.all);
  CHECK(good.most_n == approx(0.2));
  CHECK(proved_text(good) == "all proved on 2026-11-23, up to 0.2 N");
  ProvedDevice other = proved_device(protocol_of({.noise_m = 1e-3}));
  other.serial = "78 b";
  CHECK(proved_text(other) == "brought up on 2026-11-23; proved: cable, permission, firmware, homing");
  CHECK(*read_proved(file, "crooked", "77") == std::nullopt);
  REQUIRE(keep_proved(file, good));
  REQUIRE(keep_proved(file, other));
  CHECK(*read_proved(file, "crooked", "77") == good);
  CHECK(*read_proved(file, "crooked", "78 b") == other);
  CHECK(*read_proved(file, "other", "77") == std::nullopt);
  other.serial.clear();
  CHECK_FALSE(keep_proved(file, other));
}

TEST_CASE("a list of proved devices that can't be read is not overwritten") {
  const TempFolder folder;
  const std::string file = folder.file("proved-devices.toml");
  folder.write("proved-devices.toml", "this is not TOML");
  CHECK_FALSE(read_proved(file, "crooked", "77"));
  CHECK_FALSE(keep_proved(file, proved_device(protocol_of({}))));
  CHECK(read_text(file) == "this is not TOML");
}

TEST_CASE("the runner keeps real time in a thread of its own, or in the driver's, and ends in any step") {
  for (const bool calls : {false, true}) {
    CAPTURE(calls);
    std::unique_ptr<ForceDevice> device;
    if (calls)
      device = std::make_unique<ScheduledForceDevice>();
    else
      device = std::make_unique<SimulatedForceDevice>();
    auto runner = BringUpRunner::start(std::move(device), {});
    REQUIRE(runner);
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while ((*runner)->view().ask != BringUpAsk::let_go && std::chrono::steady_clock::now() < give_up) {
      if ((*runner)->settled()) (*runner)->answer(BringUpAnswer::yes);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK((*runner)->view().ask == BringUpAsk::let_go);
    (*runner)->stop();
    while (!(*runner)->view().ended && std::chrono::steady_clock::now() < give_up)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK((*runner)->view().ended);
  }
}

namespace {

struct RealDevice : ForceDevice {
  ForceCapabilities can{.name = "real", .peak_force_n = 1.0};
  const ForceCapabilities& capabilities() const override { return can; }
  Status open() override { return {}; }
  void close() override {}
  ForceSample exchange(const ForceCommand&, double) noexcept override { return {}; }
};

}  // namespace

TEST_CASE("the runner refuses simulated time for a real device") {
  CHECK_FALSE(BringUpRunner::start(std::make_unique<RealDevice>(), {.limits = {}, .threaded = false}));
}

TEST_CASE("the runner refuses a device that says nonsense once it is open, and closes it") {
  struct Boasting final : RealDevice {
    explicit Boasting(bool& closed) : closed_(closed) {}
    Status open() override { return can.continuous_force_n = 2.0, Status{}; }  // above its peak
    void close() override { closed_ = true; }
    bool& closed_;
  };
  bool closed = false;
  CHECK_FALSE(BringUpRunner::start(std::make_unique<Boasting>(closed), {}));
  CHECK(closed);
}

TEST_CASE("a driver that does not come back from an exchange ends the run, and one that does in the end is closed") {
  struct Hanging final : RealDevice {
    explicit Hanging(std::atomic<bool>& goes_on) : goes_on_(goes_on) {}
    ForceSample exchange(const ForceCommand&, double) noexcept override {
      while (!goes_on_) std::this_thread::yield();
      return {};
    }
    std::atomic<bool>& goes_on_;
  };
  std::atomic<bool> goes_on{false};
  auto runner = BringUpRunner::start(std::make_unique<Hanging>(goes_on), {.hangs_after_s = 1e-3});
  REQUIRE(runner);
  while (!(*runner)->view().ended) std::this_thread::yield();  // ended by the event alone
  const BringUpView& view = (*runner)->view();
  CHECK(view.why(BringUpStep::cable) == BringUpWhy::hangs);
  CHECK(why_text(BringUpWhy::hangs, view).find("take the device's power away") != std::string::npos);
  goes_on = true;
  while ((*runner)->view().t_s == 0.0) std::this_thread::yield();  // until a tick is over
  CHECK((*runner)->view().ended);
  CHECK((*runner)->view().why(BringUpStep::cable) == BringUpWhy::hangs);
}
