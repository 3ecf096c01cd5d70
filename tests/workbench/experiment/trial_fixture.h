// Trials with a scripted finger on a simulated device, tick by tick: no thread, no clock.
#pragma once

#include "devices/simulated/simulated_contact_display.h"
#include "tests/workbench/experiment/scripted_finger.h"
#include "workbench/experiment/run_simulated.h"
#include "workbench/experiment/trial_session.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <functional>
#include <set>
#include <sstream>

namespace tangent::test {

namespace ex = experiment;

inline std::string text_in(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

/// Two conditions, two reversals each.
inline const std::string& short_comparison() {
  static const std::string kText = R"([protocol]
kind = "discrimination"
name = "Short"
[preset]
"finger.shape" = "sphere"
"finger.radius_m" = 0.020
"force.limit_n" = 6.0
[staircase]
reversals = 2
averaged = 2
large_reversals = 1
fewest = 3
[[conditions]]
name = "C1"
start = 5
large_step = 1.4
small_step = 1.15
[[conditions]]
name = "C3"
start = 5
large_step = 1.4
small_step = 1.15
)";
  return kText;
}

/// Two objects in eight trials, in one session.
inline const std::string& short_naming() {
  static const std::string kText = R"([protocol]
kind = "identification"
name = "Short"
[preset]
"finger.shape" = "sphere"
"finger.radius_m" = 0.020
"force.limit_n" = 6.0
[objects]
names = ["cube", "octagon"]
practice = "hexagon"
[runs]
sessions = 1
blocks = 2
runs = 1
[start]
place_m = [0.0, 0.0, 0.08]
hold_s = 0.2
)";
  return kText;
}

/// A participant at the device, and the operator's keys.
class Bench {
 public:
  explicit Bench(const std::string& protocol, const std::function<void(ex::TrialOptions&)>& change = {}) {
    folder_ = std::make_unique<OwnFolder>(std::move(*OwnFolder::make()));
    start(protocol, change);
  }
  /// The same participant again, after `trials.reset()`.
  void start(const std::string& protocol, const std::function<void(ex::TrialOptions&)>& change = {}) {
    trials = *try_start(protocol, change);
    run(400);
  }
  Result<std::unique_ptr<ex::TrialSession>> try_start(const std::string& text,
                                                      const std::function<void(ex::TrialOptions&)>& change = {}) {
    ex::TrialOptions options;
    options.protocol = *ex::parse_protocol(text, "short.toml");
    options.protocol_text = text;
    options.out = folder_->path();
    options.enrolment.mark.participant = "P1";
    options.enrolment.seed = 5;
    options.enrolment.protocol_digest = ex::protocol_digest(options.protocol);
    options.session.threaded = false;
    options.session.history_s = 1.0;
    if (change) change(options);
    naming = options.protocol.identification() != nullptr;
    *script = plug;
    script->target_m = raised();
    DeviceSet devices;
    devices.force = std::make_unique<ScriptedFinger>(script);
    devices.display = std::make_unique<SimulatedContactDisplay>();
    return ex::TrialSession::start(std::move(options), std::move(devices));
  }

  void run(int ticks) {
    for (; ticks > 0; ticks -= 16) {
      trials->session().advance(16);
      trials->poll();
      if (every) every();
    }
  }
  Vec3 raised() const { return naming ? Vec3(0.0, 0.0, 0.08) : Vec3(0.0, 0.0, 0.045); }
  void to(const Vec3& target_m, int ticks = 300) {
    script->target_m = target_m;
    run(ticks);
  }
  void touch() { to(naming ? Vec3(0.0, 0.0, 0.045) : Vec3(0.0, 0.0, 0.015)); }
  void raise() { to(raised()); }
  void press(ex::TrialKey key) {
    trials->press(key);
    run(160);
  }
  ex::Phase phase() const { return trials->participant().phase; }
  const ServoRecord& tick() const { return trials->session().history().newest(); }

  /// One phase of a participant who answers 1, or the first object.
  void step() {
    switch (phase()) {
      case ex::Phase::guide:
        return to(raised(), 500);
      case ex::Phase::training:
      case ex::Phase::rest:
        return press(ex::TrialKey::enter);
      case ex::Phase::first:
        touch();
        raise();
        return press(ex::TrialKey::enter);
      case ex::Phase::second:
        touch();
        raise();
        press(ex::TrialKey::digit_1);
        return press(ex::TrialKey::enter);
      case ex::Phase::explore:
        touch();
        return press(ex::TrialKey::digit_1);
      case ex::Phase::finished:
        return;
    }
  }
  /// To the end, or until so many answers are there.
  void answer(int until = 1'000'000) {
    for (int steps = 0; !trials->finished() && trials->answers() < until && steps < 4000; ++steps) step();
  }
  ex::ReadRows table() const { return table_at(trials->rows()); }
  static ex::ReadRows table_at(const std::filesystem::path& rows) {
    const auto sidecar = ex::read_sidecar(rows);
    REQUIRE(sidecar);
    auto table = ex::read_rows(rows, sidecar->enrolment.identity());
    REQUIRE(table);
    return std::move(*table);
  }
  const std::filesystem::path& folder() const { return folder_->path(); }

  FingerScript plug;            ///< how the device is when it is opened
  std::function<void()> every;  ///< after each look of the program
  std::shared_ptr<FingerScript> script = std::make_shared<FingerScript>();
  bool naming = false;

 private:
  std::unique_ptr<OwnFolder> folder_;

 public:
  std::unique_ptr<ex::TrialSession> trials;  ///< ends before its folder does
};

}  // namespace tangent::test
