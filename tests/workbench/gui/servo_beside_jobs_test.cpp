// The servo beside the window's jobs: they run at a lower priority. What that comes to is measured with --no-skip.
#include "tests/workbench/gui/headless_app.h"

#include <sys/resource.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

using Clock = std::chrono::steady_clock;

AppOptions live_torus() {
  AppOptions options;
  options.mesh = "torus";
  options.history_s = 60.0;
  return options;
}

/// Frames at 60 Hz, until `done` or the time is over.
bool live_frames(HeadlessApp& ui, double seconds, const std::function<bool()>& done) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    ui.frame();
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  return false;
}

/// Threads of this process that yield to those of the usual priority.
int yielding_threads() {
  int count = 0;
  std::error_code gone;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", gone)) {
    const int nice = getpriority(PRIO_PROCESS, static_cast<id_t>(std::stoul(task.path().filename().string())));
    count += nice > getpriority(PRIO_PROCESS, 0) ? 1 : 0;
  }
  return count;
}

struct Job {
  const char* name;
  std::function<void(AppModel&)> start;
  std::function<bool(AppModel&)> running;
};

std::vector<Job> jobs() {
  return {{"nothing", [](AppModel&) {}, [](AppModel&) { return true; }},
          {"Tune",
           [](AppModel& model) {
             model.tune().set_trials(TuneQuestion::kMostTrials);
             model.tune().start();
           },
           [](AppModel& model) { return model.tune().running(); }},
          {"heat map", [](AppModel& model) { model.tuning().start_heat_map(); },
           [](AppModel& model) { return model.tuning().sweep().running(); }},
          {"speed against error", [](AppModel& model) { model.curves().start(); },
           [](AppModel& model) { return model.curves().running(); }},
          {"safe ranges", [](AppModel& model) { model.guard().find_ranges(); },
           [](AppModel& model) { return model.guard().finding(); }}};
}

struct Lateness {
  std::size_t ticks = 0, late = 0;
  std::uint64_t missed = 0;
  std::vector<double> by_us;
  double at(double share) const {
    return by_us[std::min(by_us.size() - 1, static_cast<std::size_t>(share * static_cast<double>(by_us.size())))];
  }
};

/// Of the ticks that the session kept from `first` on.
Lateness lateness_of(const History& records, std::uint64_t first) {
  Lateness out;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i].tick.tick < first) continue;
    const double us = records[i].lateness_ns * 1e-3;
    ++out.ticks;
    out.late += us >= 1000.0 ? 1 : 0;
    out.missed += static_cast<std::uint64_t>(us / 1000.0);
    out.by_us.push_back(us);
  }
  std::sort(out.by_us.begin(), out.by_us.end());
  return out;
}

}  // namespace

TEST_CASE("every job of the window has threads that yield to servo and window") {
  if (getpriority(PRIO_PROCESS, 0) >= 10) return;  // all of this process yields
  for (const Job& job : jobs()) {
    if (std::string(job.name) == "nothing") continue;
    CAPTURE(std::string(job.name));
    HeadlessApp ui(live_torus());
    AppModel& model = ui.model();
    REQUIRE(live_frames(ui, 60.0, [&] { return model.time().end_tick() > 300; }));
    // Those of the time machine always do; a job that is through before it is looked at has been no burden.
    const int before = yielding_threads();
    job.start(model);
    bool ended = false;
    CHECK(live_frames(ui, 60.0, [&] {
      ended = !job.running(model);
      return ended || yielding_threads() > before;
    }));
    model.tune().cancel();
    model.tuning().cancel_sweep();
    model.curves().cancel();
    model.guard().cancel();
  }
}

TEST_CASE("measure the servo beside every job" * doctest::skip()) {
  for (const Job& job : jobs()) {
    HeadlessApp ui(live_torus());
    AppModel& model = ui.model();
    REQUIRE(live_frames(ui, 30.0, [&] { return model.time().end_tick() > 3000; }));
    const std::uint64_t first = model.time().end_tick();
    const auto until = Clock::now() + std::chrono::seconds(15);
    int starts = 0;
    while (Clock::now() < until) {
      if (starts == 0 || !job.running(model)) ++starts, job.start(model);
      live_frames(ui, 0.1, [] { return false; });
    }
    const Lateness l = lateness_of(model.devices().session()->history(), first);
    REQUIRE(l.ticks > 0);
    MESSAGE(std::string(job.name) << ", started " << starts << " times: " << l.ticks << " ticks, " << l.late
                                  << " late, " << l.missed << " deadlines missed; late by p50 " << l.at(0.5) << ", p99 "
                                  << l.at(0.99) << ", p99.9 " << l.at(0.999) << ", worst " << l.by_us.back() << " us; "
                                  << model.devices().session()->status().realtime_note);
  }
}
